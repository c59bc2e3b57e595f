// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/ratio_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "table/synthetic.h"

namespace ltc {
namespace {

// Ratios of 1 but where a test says otherwise.
std::vector<EntryComparison> equal_entries(const Grid& grid) {
  return std::vector<EntryComparison>(grid.size(), {1, 1, 1});
}

TEST(RatioMap, HasEveryEntryAtItsPlace) {
  const Grid grid = testing::uneven_grid();
  std::vector<EntryComparison> entries = equal_entries(grid);
  for (std::size_t flat = 0; flat < entries.size(); ++flat)
    entries[flat].loss_a = 1 + 1e-3 * static_cast<double>(flat);
  entries[7].loss_b = std::nan("");
  const picture::TiledMap map = ratio_map(grid, entries, "a.h5", "b.h5");
  EXPECT_EQ(map.tile_rows.size, 3u);
  EXPECT_EQ(map.tile_columns.size, 2u);
  EXPECT_EQ(map.rows.size, 5u);
  EXPECT_EQ(map.columns.size, 4u);
  EXPECT_EQ(map.columns.labels.back(), "90°");
  ASSERT_EQ(map.values.size(), grid.size());
  for (std::size_t flat = 0; flat < entries.size(); ++flat)
    if (flat == 7)
      EXPECT_TRUE(std::isnan(map.values[flat]));
    else
      EXPECT_EQ(map.values[flat], static_cast<float>(entries[flat].ratio()));
  ASSERT_EQ(map.marks.size(), 3u);
  EXPECT_EQ(map.marks[0].label, "2,1,4,3");
  EXPECT_EQ(map.marks[0].index, (std::array<std::size_t, 4>{2, 1, 4, 3}));
  EXPECT_GT(picture::lay_out(map).width, 0);
}

TEST(RatioMap, BetterIsBlueAndWorseIsRedAsFarFromWhite) {
  const Grid grid = testing::uneven_grid();
  std::vector<EntryComparison> entries = equal_entries(grid);
  for (std::size_t flat = 0; flat < 20; ++flat)
    entries[flat].loss_a = 1.4;
  const picture::ColorScale colors = ratio_map(grid, entries, "a", "b").colors;
  EXPECT_DOUBLE_EQ(colors.scale.last(), 1.5);
  EXPECT_DOUBLE_EQ(colors.scale.position(1), 0.5);
  EXPECT_NEAR(colors.scale.position(1.4) + colors.scale.position(1 / 1.4), 1, 1e-12);
  EXPECT_GT(colors.at(1.4).red, colors.at(1.4).blue);
  EXPECT_GT(colors.at(1 / 1.4).blue, colors.at(1 / 1.4).red);
}

TEST(RatioMap, MirrorsDoNotStretchTheScale) {
  const Grid grid = Grid::paper({2, 2, 2, 2});
  std::vector<EntryComparison> entries = equal_entries(grid);
  for (std::size_t flat = 0; flat < 8; ++flat)  // alpha = 0
    entries[flat].loss_b = 50;
  entries[12].loss_a = 1.04;
  EXPECT_DOUBLE_EQ(ratio_map(grid, entries, "a", "b").colors.scale.last(), 1.05);
  // Unless there is nothing else.
  const Grid mirrors = Grid::paper({1, 2, 2, 2});
  entries.resize(8);
  EXPECT_DOUBLE_EQ(ratio_map(mirrors, entries, "a", "b").colors.scale.last(), 100);
}

TEST(RatioMap, OfEqualTablesIsWhiteAndHasNoMarks) {
  const Grid grid = testing::uneven_grid();
  const picture::TiledMap map = ratio_map(grid, equal_entries(grid), "a", "b");
  EXPECT_TRUE(map.marks.empty());
  EXPECT_DOUBLE_EQ(map.colors.scale.last(), 1.01);
}

// Tables that have nothing in common still have a picture: of grey cells.
TEST(RatioMap, OfNothing) {
  const Grid grid = testing::uneven_grid();
  const std::vector<EntryComparison> entries(grid.size(), {std::nan(""), 1, 1});
  EXPECT_GT(picture::render(ratio_map(grid, entries, "a", "b")).png_bytes().size(), 1000u);
}

}  // namespace
}  // namespace ltc
