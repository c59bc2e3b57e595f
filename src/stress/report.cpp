// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "stress/report.h"

#include <fmt/format.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/version.h"

namespace ltc {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const StressCounts& counts) {
  return {{"fits", counts.fits},
          {"non_finite", counts.non_finite},
          {"determinants_not_positive", counts.determinants_not_positive},
          {"above_1.05_times_best", counts.missed},
          {"success_rate", counts.success_rate()},
          {"largest_ratio", counts.largest_ratio},
          {"starts_abandoned", counts.abandoned},
          {"mean_steps", counts.mean_steps},
          {"most_steps", counts.most_steps},
          {"mean_milliseconds", 1e3 * counts.mean_seconds},
          {"most_milliseconds", 1e3 * counts.most_seconds}};
}

Json json_of(const StressReport& report, std::size_t place) {
  const StressFit& fit = report.run.fits[report.verdict.worst[place]];
  const StressLobe& lobe = report.task.lobes[fit.lobe];
  return {{"alpha", lobe.alpha},
          {"lambda", lobe.lambda},
          {"theta_degrees", lobe.theta_degrees},
          {"phi_degrees", lobe.phi_degrees},
          {"start", stress_starts()[fit.start].name},
          {"ratio", fit.ratio},  // null where it is not finite
          {"loss", fit.loss},
          {"spread", report.run.spread[fit.lobe]},
          {"determinant", fit.matrix.determinant()},
          {"command", report.commands.at(place)}};
}

Json json_of(const StressReport& report) {
  Json by_start, worst = Json::array();
  for (std::size_t start = 0; start < stress_starts().size(); ++start)
    by_start[stress_starts()[start].name] = json_of(report.verdict.by_start[start]);
  for (std::size_t place = 0; place < report.verdict.worst.size(); ++place)
    worst.push_back(json_of(report, place));
  return {{"name", report.name},
          {"lobes", report.task.lobes.size()},
          {"fits", report.run.fits.size()},
          {"seconds", report.run.seconds},
          {"held_to_the_bars", report.must_pass},
          {"missed_bars", report.verdict.missed_bars},
          {"own_starts", json_of(report.verdict.own)},
          {"bad_starts", json_of(report.verdict.bad)},
          {"by_start", by_start},
          {"worst", worst}};
}

picture::MapAxis map_axis(const char* title, const std::vector<double>& nodes, const char* sign) {
  picture::MapAxis axis{nodes.size(), title};
  for (const double node : nodes)
    axis.labels.push_back(fmt::format("{:g}{}", node, sign));
  return axis;
}

std::size_t place_of(const std::vector<double>& nodes, double value) {
  return static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), value) - nodes.begin());
}

// The fits of a cell, gathered.
struct Cell {
  std::size_t fits = 0, successes = 0;
  double largest_ratio = std::numeric_limits<double>::quiet_NaN();
};

std::vector<Cell> cells_of(const StressReport& report) {
  const StressAxes& axes = report.axes;
  const std::size_t thetas = axes.theta_degrees.size(), lambdas = axes.lambda.size();
  std::vector<Cell> cells(2 * thetas * axes.alpha.size() * lambdas);
  for (const StressFit& fit : report.run.fits) {
    const StressLobe& lobe = report.task.lobes[fit.lobe];
    if (!lobe.on_grid)
      continue;
    const std::size_t row = stress_starts()[fit.start].own ? 0 : 1;
    const std::size_t tile = row * thetas + place_of(axes.theta_degrees, lobe.theta_degrees);
    Cell& cell = cells.at((tile * axes.alpha.size() + place_of(axes.alpha, lobe.alpha)) * lambdas +
                          place_of(axes.lambda, lobe.lambda));
    ++cell.fits;
    cell.successes += succeeded(fit);
    if (fit.finite() && fit.determinant_positive())
      cell.largest_ratio = std::fmax(cell.largest_ratio, fit.ratio);
  }
  return cells;
}

picture::TiledMap map_of(const StressReport& report, picture::ColorScale colors,
                         const std::function<double(const Cell&)>& value) {
  picture::TiledMap map{.colors = std::move(colors)};
  map.tile_rows = {2, "start", {"own", "bad"}};
  map.tile_columns = map_axis("θ", report.axes.theta_degrees, "°");
  map.rows = map_axis("α", report.axes.alpha, "");
  map.columns = map_axis("λ", report.axes.lambda, "");
  for (const Cell& cell : cells_of(report))
    map.values.push_back(static_cast<float>(value(cell)));
  map.words.title = report.name;
  map.words.lines_below = {
      fmt::format("{} lobes, {} starts each, {} of them the program's own; αx = α, αy = λα",
                  report.task.lobes.size(), stress_starts().size(),
                  std::count_if(stress_starts().begin(), stress_starts().end(),
                                [](const StressStartKind& kind) { return kind.own; })),
      fmt::format("Judged by {} graded samples and {} directions; cells gather all φ and starts",
                  report.task.judge.samples, report.task.judge.directions)};
  return map;
}

// Colours of ratios end here: beyond it a lobe is lost altogether.
constexpr double largest_shown_ratio = 1000;

}  // namespace

std::string stress_json(const std::vector<StressReport>& reports) {
  Json solvers = Json::array();
  for (const StressReport& report : reports)
    solvers.push_back(json_of(report));
  Json all = {{"generator", generator()}, {"solvers", solvers}};
  if (!reports.empty()) {
    const CompareSettings& judge = reports.front().task.judge;
    all["judge"] = {
        {"samples", judge.samples}, {"directions", judge.directions}, {"seed", judge.seed}};
  }
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string stress_csv(const std::vector<StressReport>& reports) {
  std::string text =
      "solver,alpha,lambda,theta_degrees,phi_degrees,start,ratio,loss,spread,determinant,"
      "abandoned,steps,milliseconds\n";
  for (const StressReport& report : reports)
    for (const StressFit& fit : report.run.fits) {
      const StressLobe& lobe = report.task.lobes[fit.lobe];
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", report.name, lobe.alpha,
                          lobe.lambda, lobe.theta_degrees, lobe.phi_degrees,
                          stress_starts()[fit.start].name, fit.ratio, fit.loss,
                          report.run.spread[fit.lobe], fit.matrix.determinant(),
                          fit.start_abandoned ? 1 : 0, fit.steps, 1e3 * fit.seconds);
    }
  return text;
}

picture::TiledMap success_map(const StressReport& report) {
  picture::TiledMap map = map_of(report,
                                 {picture::Scale::linear(0, 1), &picture::ColorMap::viridis(),
                                  "fits within 1.05 × the best", picture::TickFormat::percent},
                                 [](const Cell& cell) {
                                   return cell.fits == 0 ? std::numeric_limits<double>::quiet_NaN()
                                                         : static_cast<double>(cell.successes) /
                                                               static_cast<double>(cell.fits);
                                 });
  map.words.subtitle = "Share of fits that come within 1.05 times the least loss at their lobe";
  return map;
}

picture::TiledMap ratio_map(const StressReport& report) {
  double largest = largest_good_ratio;
  for (const Cell& cell : cells_of(report))
    largest = std::fmax(largest, cell.largest_ratio);
  picture::TiledMap map =
      map_of(report,
             {picture::Scale::logarithmic(1, std::min(largest, largest_shown_ratio)),
              &picture::ColorMap::viridis(), "largest loss over the least at the lobe"},
             [](const Cell& cell) { return cell.largest_ratio; });
  map.words.subtitle = "Largest loss over the least at the lobe";
  return map;
}

}  // namespace ltc
