// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "interpolate/axis_cells.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ltc {
namespace {

TEST(AxisCells, KeepBothEndsWhateverTheSpacing) {
  EXPECT_EQ(every(4, 12), (AxisNodes{0, 4, 8, 11}));
  EXPECT_EQ(every(4, 13), (AxisNodes{0, 4, 8, 12}));
  EXPECT_EQ(every(1, 3), (AxisNodes{0, 1, 2}));
  EXPECT_EQ(every(8, 1), AxisNodes{0});
}

TEST(AxisCells, HalvedUntilNothingIsBetween) {
  AxisNodes nodes{0, 1, 4, 11};
  nodes = halved(nodes);
  EXPECT_EQ(nodes, (AxisNodes{0, 1, 2, 4, 7, 11}));
  EXPECT_EQ(largest_gap(nodes), 4u);
  nodes = halved(halved(nodes));
  EXPECT_EQ(nodes, every(1, 12));
  EXPECT_EQ(halved(nodes), nodes);
  EXPECT_EQ(halved(AxisNodes{0}), AxisNodes{0});
}

TEST(AxisCells, HoldTheirEnds) {
  const AxisNodes nodes{0, 2, 5};
  const auto expect = [&](std::size_t index, std::size_t first, std::size_t last) {
    const CellRange range = cells_at(nodes, index);
    EXPECT_EQ(range.first, first) << index;
    EXPECT_EQ(range.last, last) << index;
  };
  expect(0, 0, 0);
  expect(1, 0, 0);
  expect(2, 0, 1);
  expect(4, 1, 1);
  expect(5, 1, 1);
  EXPECT_EQ(cell_count(nodes), 2u);
  EXPECT_EQ(cell_count({0}), 1u);
  EXPECT_EQ(middle_of_cell(nodes, 1), 3u);
  EXPECT_EQ(middle_of_cell({0}, 0), 0u);
}

double interpolated(const AxisNodes& nodes, std::size_t index, int power) {
  const Stencil stencil = stencil_at(nodes, index);
  double sum = 0;
  for (std::size_t i = 0; i < stencil.count; ++i)
    sum += stencil.weights[i] * std::pow(static_cast<double>(nodes[stencil.first + i]) / 20, power);
  return sum;
}

// Of order one, so 1e-12 is what rounding leaves of it.
TEST(AxisCells, CubicsAreExact) {
  const AxisNodes nodes{0, 1, 3, 8, 16, 20};
  for (std::size_t index = 0; index <= 20; ++index)
    for (int power = 0; power <= 3; ++power)
      EXPECT_NEAR(interpolated(nodes, index, power),
                  std::pow(static_cast<double>(index) / 20, power), 1e-12)
          << index << "^" << power;
  EXPECT_GT(std::abs(interpolated(nodes, 12, 4) - std::pow(12.0 / 20, 4)), 1e-3);
}

TEST(AxisCells, FewerNodesThanACubicHas) {
  EXPECT_NEAR(interpolated({0, 10, 20}, 7, 2), 0.35 * 0.35, 1e-12);
  EXPECT_NEAR(interpolated({0, 20}, 7, 1), 0.35, 1e-12);
  EXPECT_EQ(stencil_at({0}, 0).count, 1u);
  EXPECT_EQ(stencil_at({0, 10, 20}, 10).count, 1u);
}

}  // namespace
}  // namespace ltc
