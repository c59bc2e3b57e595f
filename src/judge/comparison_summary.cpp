// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/comparison_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ltc {
namespace {

bool is_judged(const EntryComparison& entry) {
  return std::isfinite(entry.ratio());
}

ComparisonRow summarize_row(std::string name, const std::vector<EntryComparison>& entries,
                            const std::vector<bool>& include) {
  ComparisonRow row;
  row.name = std::move(name);
  std::vector<bool> judged(entries.size());
  for (std::size_t flat = 0; flat < entries.size(); ++flat) {
    judged[flat] = include[flat] && is_judged(entries[flat]);
    row.entries += judged[flat];
    row.a_nearer += judged[flat] && entries[flat].loss_a < entries[flat].loss_b;
    row.b_nearer += judged[flat] && entries[flat].loss_b < entries[flat].loss_a;
  }
  const auto of = [&](auto figure) { return statistics_of(figures_of(entries, figure), judged); };
  using Entry = const EntryComparison&;
  row.loss_a = of([](Entry e) { return e.loss_a; });
  row.loss_b = of([](Entry e) { return e.loss_b; });
  row.ratio = of([](Entry e) { return e.ratio(); });
  row.relative_distance = of([](Entry e) { return e.relative_distance(); });
  row.distance = of([](Entry e) { return e.distance; });
  row.matrix_difference = of([](Entry e) { return e.matrix_difference; });
  row.amplitude_difference = of([](Entry e) { return e.amplitude_difference; });
  row.fresnel_difference = of([](Entry e) { return e.fresnel_difference; });
  return row;
}

}  // namespace

Statistics ratio_statistics(const std::vector<EntryComparison>& entries,
                            const std::vector<bool>& include) {
  return summarize_row("", entries, include.empty() ? std::vector(entries.size(), true) : include)
      .ratio;
}

bool is_mirror(const Grid& grid, std::size_t alpha_index) {
  return grid.alpha.nodes[alpha_index] <= grid.alpha_min;
}

bool has_mirrors_and_others(const Grid& grid) {
  return is_mirror(grid, 0) && !is_mirror(grid, grid.alpha.size() - 1);
}

std::vector<ComparisonRow> summarize_rows(const Grid& grid,
                                          const std::vector<EntryComparison>& entries) {
  std::vector<ComparisonRow> rows;
  const auto add = [&](std::string name, auto&& contains) {
    std::vector<bool> include(entries.size());
    for (std::size_t flat = 0; flat < entries.size(); ++flat)
      include[flat] = contains(grid.node(flat).alpha);
    rows.push_back(summarize_row(std::move(name), entries, include));
  };
  const std::vector<double>& alpha = grid.alpha.nodes;
  add("all", [](std::size_t) { return true; });
  if (has_mirrors_and_others(grid))
    add("alpha > min", [&](std::size_t plane) { return !is_mirror(grid, plane); });
  for (std::size_t own = 0; own < alpha.size(); ++own)
    add(fmt::format("alpha {:.3f}", alpha[own]), [&](std::size_t plane) { return plane == own; });
  return rows;
}

std::vector<std::size_t> largest_of(std::span<const double> values, std::size_t count) {
  std::vector<std::size_t> falling;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i]))
      falling.push_back(i);
  std::stable_sort(falling.begin(), falling.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  falling.resize(std::min(falling.size(), count));
  return falling;
}

bool has_albedo(const Table& table) {
  const auto is_finite = [](float value) { return std::isfinite(value); };
  return std::any_of(table.amplitude.begin(), table.amplitude.end(), is_finite) ||
         std::any_of(table.fresnel.begin(), table.fresnel.end(), is_finite);
}

Coverage coverage_of(const Table& a, const Table& b, const std::vector<EntryComparison>& entries) {
  Coverage coverage;
  const bool albedo = has_albedo(a) && has_albedo(b);
  const auto is_complete = [&](const EntryComparison& entry) {
    return is_judged(entry) && std::isfinite(entry.distance) &&
           (!albedo ||
            (std::isfinite(entry.amplitude_difference) && std::isfinite(entry.fresnel_difference)));
  };
  const auto count = [](std::size_t& counter, std::size_t& first, std::size_t flat) {
    if (counter++ == 0)
      first = flat;
  };
  for (std::size_t flat = 0; flat < entries.size(); ++flat) {
    const bool in_a = has_values(a.status[flat]), in_b = has_values(b.status[flat]);
    if (in_a && !in_b)
      count(coverage.only_a, coverage.first_only_a, flat);
    if (in_b && !in_a)
      count(coverage.only_b, coverage.first_only_b, flat);
    if (in_a && in_b && !is_complete(entries[flat]))
      count(coverage.unjudged, coverage.first_unjudged, flat);
  }
  return coverage;
}

std::vector<Exceedance> exceedances(const std::vector<EntryComparison>& entries, double tolerance) {
  std::vector<Exceedance> result;
  const auto check = [&](const char* figure, auto&& value_of) {
    Exceedance exceedance{figure};
    for (std::size_t flat = 0; flat < entries.size(); ++flat) {
      const double value = value_of(entries[flat]);
      if (std::isnan(value) || value <= tolerance)
        continue;
      if (exceedance.entries++ == 0 || value > exceedance.largest) {
        exceedance.largest = value;
        exceedance.largest_entry = flat;
      }
    }
    if (exceedance.entries > 0)
      result.push_back(exceedance);
  };
  using Entry = const EntryComparison&;
  check("lobe distance", [](Entry e) { return e.relative_distance(); });
  check("amplitude", [](Entry e) { return e.amplitude_difference; });
  check("Fresnel term", [](Entry e) { return e.fresnel_difference; });
  return result;
}

}  // namespace ltc
