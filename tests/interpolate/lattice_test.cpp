// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "interpolate/lattice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ltc {
namespace {

const Grid grid = Grid::paper({9, 6, 12, 1});
const LatticeAxes axes = {AxisNodes{0, 2, 4, 6, 8}, every(1, 6), AxisNodes{0, 3, 6, 8, 11}, {0}};

// Of degree `degree` in each index, another one for each of the ten values.
NodeValues polynomial(const LatticePlace& at, int degree) {
  NodeValues values;
  for (int i = 0; i < 10; ++i) {
    values[i] = 1;
    for (const std::size_t index : at)
      values[i] *= 1 + std::pow(static_cast<double>(index) / 10, degree) * (1 + i);
  }
  return values;
}

Lattice filled(int degree) {
  Lattice lattice(grid, axes);
  for (std::size_t i = 0; i < lattice.size(); ++i)
    lattice[i] = polynomial(grid.indices(lattice.flat(i)), degree);
  return lattice;
}

double relative_error(const NodeValues& a, const NodeValues& b) {
  return ((a - b) / b).abs().maxCoeff();
}

TEST(Lattice, TensorCubicsAreExactAtNodesAndInPlanes) {
  const Lattice lattice = filled(3), steeper = filled(5);
  EXPECT_EQ(lattice.size(), 5u * 6 * 5);
  double largest = 0, largest_of_steeper = 0;
  for (std::size_t alpha = 0; alpha < 9; ++alpha)
    for (std::size_t lambda = 0; lambda < 6; ++lambda) {
      const std::vector<NodeValues> plane = lattice.plane(alpha, lambda, every(1, 12), {0});
      for (std::size_t theta = 0; theta < 12; ++theta) {
        const LatticePlace at{alpha, lambda, theta, 0};
        largest = std::max({largest, relative_error(lattice.at(at), polynomial(at, 3)),
                            relative_error(plane[theta], polynomial(at, 3))});
        largest_of_steeper =
            std::max(largest_of_steeper, relative_error(steeper.at(at), polynomial(at, 5)));
      }
    }
  EXPECT_LT(largest, 1e-11);  // rounding of sums of some hundred terms
  EXPECT_GT(largest_of_steeper, 1e-3);
}

TEST(LatticeCells, KnowTheirMiddlesAndWhatTheyHold) {
  LatticeCells cells(axes, false);
  ASSERT_EQ(cells.size(), 4u * 5 * 4);
  const std::size_t number = (1 * 5 + 2) * 4 + 3;  // alpha 2 to 4, lambda 2 to 3, theta 8 to 11
  EXPECT_EQ(cells.corner(number), (LatticePlace{2, 2, 8, 0}));
  EXPECT_EQ(cells.middle(number), (LatticePlace{3, 2, 9, 0}));
  EXPECT_TRUE(cells.has_inside(number));
  cells.set(number, true);
  EXPECT_TRUE(cells[number]);
  EXPECT_TRUE(cells.behind({2, 2, 8, 0}));
  EXPECT_TRUE(cells.behind({3, 2, 10, 0}));
  EXPECT_FALSE(cells.behind({4, 2, 8, 0}));
  for (const LatticePlace& corner : {LatticePlace{2, 2, 8, 0}, LatticePlace{4, 3, 11, 0}})
    EXPECT_TRUE(cells.any_at(corner));
  EXPECT_FALSE(cells.any_at({5, 3, 11, 0}));
  EXPECT_FALSE(cells.any_at({4, 3, 7, 0}));
}

TEST(LatticeCells, HaveNothingInsideOnceAllNodesAreTaken) {
  const LatticeAxes all = {every(1, 9), every(1, 6), every(1, 12), {0}};
  const LatticeCells cells(all, true);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    EXPECT_FALSE(cells.has_inside(cell));
  EXPECT_EQ(halved(halved(axes)), all);
  EXPECT_EQ(largest_gap(axes), 3u);
}

}  // namespace
}  // namespace ltc
