// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/ratio_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "brdf/lobe_model.h"
#include "judge/comparison_summary.h"
#include "report/table_map.h"

namespace ltc {
namespace {

// The least of these that is not below `factor`: round, so that its inverse is read off as well.
double rounded_bound(double factor) {
  for (const double bound : {1.01, 1.02, 1.05, 1.1, 1.2, 1.5, 2.0, 3.0, 5.0, 10.0, 100.0})
    if (factor <= bound)
      return bound;
  return 1000;
}

// How far from 1 the scale reaches.
double color_bound(const Grid& grid, const std::vector<EntryComparison>& entries) {
  const bool only_mirrors = is_mirror(grid, grid.alpha.size() - 1);
  std::vector<bool> counts(entries.size());
  for (std::size_t flat = 0; flat < entries.size(); ++flat)
    counts[flat] = std::isfinite(entries[flat].ratio()) &&
                   (only_mirrors || !is_mirror(grid, grid.node(flat).alpha));
  const std::vector<double> factors = figures_of(
      entries, [](const EntryComparison& e) { return std::exp(std::abs(std::log(e.ratio()))); });
  const Statistics statistics = statistics_of(factors, counts);
  return rounded_bound(statistics.count > 0 ? statistics.p99 : 1);
}

std::string row_text(const ComparisonRow& row) {
  return fmt::format(
      "{}: A nearer in {} of {}, ratio {:.4f} in the mean, {:.4f} at the 95th "
      "percentile, {:.4f} at most",
      row.name, row.a_nearer, row.entries, row.ratio.mean, row.ratio.p95, row.ratio.largest);
}

picture::Words words_of(const Grid& grid, const std::vector<EntryComparison>& entries,
                        const std::string& name_a, const std::string& name_b) {
  picture::Words words;
  const std::string model(grid.model->label());
  words.title = "Loss to " + model + ", A over B";
  words.subtitle = "Blue: A is nearer to " + model + "; red: B is nearer; grey: not in both tables";
  words.lines_below = {"A: " + name_a, "B: " + name_b};
  const std::vector<ComparisonRow> rows = summarize_rows(grid, entries);
  words.lines_below.push_back(row_text(rows[0]));
  if (rows.size() == grid.alpha.size() + 2)  // one for what is left without mirrors
    words.lines_below.push_back(row_text(rows[1]));
  return words;
}

}  // namespace

picture::TiledMap ratio_map(const Grid& grid, const std::vector<EntryComparison>& entries,
                            const std::string& name_a, const std::string& name_b,
                            std::size_t marked) {
  const std::vector<double> ratios =
      figures_of(entries, [](const EntryComparison& entry) { return entry.ratio(); });
  picture::TiledMap map = table_map(
      grid, ratios, picture::ratio_colors(color_bound(grid, entries), "loss of A over loss of B"));
  map.words = words_of(grid, entries, name_a, name_b);
  for (const std::size_t flat : largest_of(ratios, marked))
    if (ratios[flat] > 1)
      map.marks.push_back(mark_of(grid, flat));
  return map;
}

}  // namespace ltc
