// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/comparison_summary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "table/synthetic.h"

namespace ltc {
namespace {

const double nan = std::nan("");

TEST(LargestOf, LargestFirstAndEqualOnesInOrder) {
  const std::vector<double> values = {1, nan, 3, 2, 3};
  EXPECT_EQ(largest_of(values, 3), (std::vector<std::size_t>{2, 4, 3}));
  EXPECT_EQ(largest_of(values, 9), (std::vector<std::size_t>{2, 4, 3, 0}));
  EXPECT_EQ(largest_of({}, 2), std::vector<std::size_t>{});
}

// Figures that differ from entry to entry; A is nearer where the flat index is even.
std::vector<EntryComparison> example(const Grid& grid) {
  std::vector<EntryComparison> entries(grid.size());
  for (std::size_t flat = 0; flat < entries.size(); ++flat)
    entries[flat] = {
        flat % 2 ? 2.0 : 1.0, flat % 2 ? 1.0 : 2.0, 10, 0.1 * double(flat % 4), 0.01, 0.001, 0.002};
  return entries;
}

TEST(ComparisonRows, AllWithoutMirrorsAndEveryPlane) {
  const Grid grid = Grid::paper({3, 1, 2, 2});
  std::vector<EntryComparison> entries = example(grid);
  entries[0].loss_a = 4;  // in the plane alpha = 0
  const std::vector<ComparisonRow> rows = summarize_rows(grid, entries);
  ASSERT_EQ(rows.size(), 5u);
  const char* names[] = {"all", "alpha > min", "alpha 0.000", "alpha 0.500", "alpha 1.000"};
  const std::size_t counts[] = {12, 8, 4, 4, 4}, nearer[] = {5, 4, 1, 2, 2};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].name, names[i]);
    EXPECT_EQ(rows[i].entries, counts[i]) << names[i];
    EXPECT_EQ(rows[i].a_nearer, nearer[i]) << names[i];
    EXPECT_EQ(rows[i].b_nearer, counts[i] - nearer[i]) << names[i];
    EXPECT_DOUBLE_EQ(rows[i].relative_distance.largest, 0.03) << names[i];
    EXPECT_DOUBLE_EQ(rows[i].matrix_difference.mean, 0.01) << names[i];
    EXPECT_DOUBLE_EQ(rows[i].amplitude_difference.p95, 0.001) << names[i];
    EXPECT_DOUBLE_EQ(rows[i].fresnel_difference.largest, 0.002) << names[i];
  }
  EXPECT_EQ(rows[0].loss_a.largest, 4);
  EXPECT_EQ(rows[1].loss_a.largest, 2);
  EXPECT_EQ(rows[2].ratio.largest, 2);
}

TEST(ComparisonRows, NoRowWithoutMirrorsWhereThereAreNoneOrOnlyMirrors) {
  for (const Grid& grid : {testing::uneven_grid(), Grid::paper({1, 1, 2, 2})}) {
    const std::vector<ComparisonRow> rows = summarize_rows(grid, example(grid));
    EXPECT_EQ(rows.size(), 1 + grid.alpha.size());
  }
}

TEST(ComparisonRows, EqualLossesAreNearerToNeither) {
  const Grid grid = Grid::paper({1, 1, 1, 2});
  const std::vector<ComparisonRow> rows =
      summarize_rows(grid, {{1, 1, 1}, {1, nan, 1}});  // the second is not in both
  EXPECT_EQ(rows[0].entries, 1u);
  EXPECT_EQ(rows[0].a_nearer + rows[0].b_nearer, 0u);
  EXPECT_EQ(rows[0].amplitude_difference.count, 0u);
}

TEST(Coverage, CountsWhatOneTableLacksAndWhatCannotBeJudged) {
  const Grid grid = Grid::paper({1, 1, 2, 2});
  Table a = testing::synthetic_table(grid, Storage::matrix), b = a;
  std::vector<EntryComparison> entries = example(grid);
  const auto faults = [&] {
    const Coverage coverage = coverage_of(a, b, entries);
    return std::array{coverage.only_a, coverage.only_b, coverage.unjudged};
  };
  using Counts = std::array<std::size_t, 3>;
  EXPECT_EQ(faults(), (Counts{0, 0, 0}));
  b.status[1] = Status::skipped;
  entries[1].loss_b = entries[1].distance = nan;
  EXPECT_EQ(faults(), (Counts{1, 0, 0}));
  EXPECT_EQ(coverage_of(a, b, entries).first_only_a, 1u);
  a.status[3] = Status::failed;
  entries[3].loss_a = entries[3].distance = nan;
  EXPECT_EQ(faults(), (Counts{1, 1, 0}));
  entries[2].loss_a = nan;
  EXPECT_EQ(faults(), (Counts{1, 1, 1}));
  EXPECT_EQ(coverage_of(a, b, entries).first_unjudged, 2u);
  entries[0].amplitude_difference = nan;
  EXPECT_EQ(faults(), (Counts{1, 1, 2}));
  // A table of matrices alone has no terms to compare.
  b.amplitude.assign(4, std::nanf(""));
  b.fresnel.assign(4, std::nanf(""));
  EXPECT_FALSE(has_albedo(b));
  EXPECT_EQ(faults(), (Counts{1, 1, 1}));
}

TEST(Tolerance, NamesEveryFigureThatPassesIt) {
  std::vector<EntryComparison> entries = example(Grid::paper({1, 1, 2, 2}));
  // Distances over the spread are 0, 0.01, 0.02, 0.03; amplitudes 0.001, Fresnel terms 0.002.
  EXPECT_TRUE(exceedances(entries, 0.0301).empty());
  const std::vector<Exceedance> some = exceedances(entries, 0.015);
  ASSERT_EQ(some.size(), 1u);
  EXPECT_EQ(some[0].figure, "lobe distance");
  EXPECT_EQ(some[0].entries, 2u);
  EXPECT_DOUBLE_EQ(some[0].largest, 0.03);
  EXPECT_EQ(some[0].largest_entry, 3u);
  const std::vector<Exceedance> all = exceedances(entries, 0);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].entries, 3u);
  EXPECT_EQ(all[1].figure, "amplitude");
  EXPECT_EQ(all[1].entries, 4u);
  EXPECT_EQ(all[2].figure, "Fresnel term");
  EXPECT_EQ(all[2].largest, 0.002);
  // What is not compared exceeds nothing; nothing passes a tolerance that is no number.
  for (EntryComparison& entry : entries)
    entry.amplitude_difference = entry.fresnel_difference = nan;
  EXPECT_EQ(exceedances(entries, 0).size(), 1u);
  EXPECT_EQ(exceedances(entries, nan).size(), 1u);
}

}  // namespace
}  // namespace ltc
