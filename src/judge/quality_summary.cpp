// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/quality_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/angle.h"
#include "core/range.h"
#include "ltc/ltsd.h"

namespace ltc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool judged(const QueryQuality& query) {
  return query.state == QueryState::judged;
}

bool singular(const QueryQuality& query) {
  return judged(query) && !std::isfinite(query.area_light.mean_absolute);
}

// One value a query, NaN where it is not judged.
std::vector<double> of_judged(const QualityReport& report,
                              const std::function<double(std::size_t)>& value) {
  std::vector<double> values(report.queries.size(), nan);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (judged(report.queries[i]))
      values[i] = value(i);
  return values;
}

void count_states(QualityReport& report) {
  const auto count = [&](auto&& is) {
    return static_cast<std::size_t>(
        std::count_if(report.queries.begin(), report.queries.end(), is));
  };
  report.queries_outside = count([](auto& query) { return query.state == QueryState::outside; });
  report.queries_missing = count([](auto& query) { return query.state == QueryState::missing; });
  report.queries_singular = count(singular);
}

// NaN where nothing is judged; never -NaN, which is what 0/0 gives.
void set_noise(QualityReport& report) {
  report.area_light_noise = report.area_light_mean_noise = nan;
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < report.queries.size(); ++i)
    if (judged(report.queries[i])) {
      squares += std::pow(report.floors[i].area_light.standard_error, 2);
      ++count;
    }
  if (count == 0)
    return;
  report.area_light_noise = std::sqrt(squares / count);
  report.area_light_mean_noise =
      report.area_light_noise / std::sqrt(count * static_cast<double>(report.settings.quads));
}

// The least and largest of a parameter that belong to one band.
struct BandedParameter {
  std::string name, unit;
  std::vector<double> edges;
  std::function<double(const Lobe&)> value;
};

std::vector<BandedParameter> banded_parameters() {
  const auto degrees = [](double radians) { return radians / radians_per_degree; };
  constexpr double end = std::numeric_limits<double>::infinity();
  return {
      {"perceptual roughness",
       "",
       {0.1, 0.2, 0.3, 0.4, end},
       [](const Lobe& lobe) { return std::sqrt(std::max(lobe.alpha_x, lobe.alpha_y)); }},
      {"theta",
       "°",
       {0, 30, 60, 75, end},
       [=](const Lobe& lobe) { return degrees(lobe.theta_radians); }},
      {"lambda",
       "",
       {0, 0.1, 0.25, 0.5, end},
       [](const Lobe& lobe) {
         return std::min(lobe.alpha_x, lobe.alpha_y) / std::max(lobe.alpha_x, lobe.alpha_y);
       }},
      {"phi", "°", {0, 30, 60, end}, [=](const Lobe& lobe) { return degrees(lobe.phi_radians); }},
  };
}

Band band_of(const QualityReport& report, const BandedParameter& parameter, double first,
             double last) {
  std::vector<double> table, floor, table_light, floor_light;
  for (std::size_t i = 0; i < report.queries.size(); ++i) {
    const double value = parameter.value(report.floors[i].lobe);
    if (!judged(report.queries[i]) || !(value >= first && value < last))
      continue;
    table.push_back(report.queries[i].relative_loss);
    floor.push_back(report.floors[i].relative_loss);
    table_light.push_back(report.queries[i].area_light.mean_absolute);
    floor_light.push_back(report.floors[i].area_light.mean_absolute);
  }
  return {first,
          last,
          table.size(),
          statistics_of(table).mean,
          statistics_of(floor).mean,
          statistics_of(table_light).mean,
          statistics_of(floor_light).mean};
}

std::vector<Bands> all_bands(const QualityReport& report) {
  std::vector<Bands> all;
  for (const BandedParameter& parameter : banded_parameters()) {
    Bands bands{parameter.name, parameter.unit, {}};
    // What lies below the first edge belongs to no band of the default range, but may to others.
    std::vector<double> edges = parameter.edges;
    if (edges.front() > 0)
      edges.insert(edges.begin(), 0);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      const Band band = band_of(report, parameter, edges[i], edges[i + 1]);
      if (band.queries > 0)
        bands.bands.push_back(band);
    }
    all.push_back(std::move(bands));
  }
  return all;
}

std::vector<std::size_t> worst_queries(const QualityReport& report) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < report.queries.size(); ++i)
    if (judged(report.queries[i]))
      order.push_back(i);
  const auto excess = [&](std::size_t i) {
    return report.queries[i].relative_loss - report.floors[i].relative_loss;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return excess(a) > excess(b); });
  order.resize(std::min(order.size(), report.settings.worst));
  return order;
}

}  // namespace

void summarize_quality(QualityReport& report) {
  const auto& queries = report.queries;
  const auto& floors = report.floors;
  const Creases creases = report.settings.floor_fit.creases();
  report.nodes = statistics_of(report.node_losses);
  report.node_fits = statistics_of(report.node_fit_ratios);
  count_states(report);
  report.query_losses =
      statistics_of(of_judged(report, [&](auto i) { return queries[i].relative_loss; }));
  report.floor_losses =
      statistics_of(of_judged(report, [&](auto i) { return floors[i].relative_loss; }));
  report.below_horizon =
      statistics_of(of_judged(report, [&](auto i) { return queries[i].below_horizon; }));
  report.floor_below_horizon = statistics_of(of_judged(report, [&](auto i) {
    return share_below_horizon({floors[i].matrix, floors[i].fold, creases});
  }));
  report.area_light =
      statistics_of(of_judged(report, [&](auto i) { return queries[i].area_light.mean_absolute; }));
  report.area_light_with_amplitude = statistics_of(of_judged(
      report, [&](auto i) { return queries[i].area_light_with_amplitude.mean_absolute; }));
  report.floor_area_light =
      statistics_of(of_judged(report, [&](auto i) { return floors[i].area_light.mean_absolute; }));
  set_noise(report);
  report.bands = all_bands(report);
  report.worst_queries = worst_queries(report);
}

std::vector<ThresholdCheck> check_thresholds(const QualityReport& report,
                                             const QualityThresholds& thresholds,
                                             const std::set<std::string>& demanded) {
  const auto check = [&](const char* key, const char* what, double value, double limit) {
    const bool passed = std::isnan(value) ? !demanded.contains(key) : value <= limit;
    ThresholdCheck result{key, what, value, limit, passed, ""};
    if (limit >= no_limit)
      result.reason = "no limit is set";
    return result;
  };
  // A few of many queries say nothing of the table, which serves another part of the range.
  const auto mean_of_queries = [&](const Statistics& figures) {
    constexpr std::size_t few = 20, least_share = 10;
    const bool too_few = figures.count < few && figures.count * least_share < report.queries.size();
    return too_few ? std::numeric_limits<double>::quiet_NaN() : figures.mean;
  };
  return {check("quality.node_loss", "mean relative loss at nodes", report.nodes.mean,
                thresholds.node_loss),
          check("quality.query_loss", "mean relative loss between nodes",
                mean_of_queries(report.query_losses), thresholds.query_loss),
          check("quality.area_light_error", "mean error under area lights",
                mean_of_queries(report.area_light), thresholds.area_light_error)};
}

std::string verdict_text(const ThresholdCheck& check) {
  const char* const judged = check.passed ? "passed" : "FAILED";
  return check.judged() ? judged : "not judged";
}

std::string failure_line(const ThresholdCheck& check) {
  if (!check.judged())
    return fmt::format(
        "{} is not judged, for there is too little to judge, but {} = {:.4g} is demanded",
        check.what, check.key, check.limit);
  return fmt::format("{} is {:.4g}, above {} = {:.4g}", check.what, check.value, check.key,
                     check.limit);
}

std::string band_text(const Bands& bands, const Band& band) {
  if (std::isinf(band.last))
    return fmt::format("> {:.4g}{}", band.first, bands.unit);
  return fmt::format("{:.4g}–{:.4g}{}", band.first, band.last, bands.unit);
}

}  // namespace ltc
