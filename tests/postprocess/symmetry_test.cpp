// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The zeros of equation (16), view by view.
#include "postprocess/symmetry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ltc {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2;

// Entries 1 to 9 in row-major order; what equation (16) blots out is 0.
Eigen::Matrix3d counted() {
  Eigen::Matrix3d matrix;
  matrix << 1, 2, 3, 4, 5, -6, 7, -8, 9;
  return matrix;
}

TEST(Symmetry, ZerosOfEquationSixteen) {
  Eigen::Matrix3d along_x, along_y, upward;
  along_x << 1, 0, 3, 0, 5, 0, 7, 0, 9;
  along_y << 1, 0, 0, 0, 5, -6, 0, -8, 9;
  upward << 1, 0, 0, 0, 5, 0, 0, 0, 9;

  Eigen::Matrix3d matrix = counted();
  EXPECT_EQ(enforce_symmetry(0.7, 0, matrix), 8);
  EXPECT_EQ(matrix, along_x);
  matrix = counted();
  EXPECT_EQ(enforce_symmetry(0.7, kHalfPi, matrix), 7);
  EXPECT_EQ(matrix, along_y);
  for (const double phi : {0.0, 0.4, kHalfPi}) {
    matrix = counted();
    EXPECT_EQ(enforce_symmetry(0, phi, matrix), 8);
    EXPECT_EQ(matrix, upward);
  }
  matrix = counted();
  EXPECT_EQ(enforce_symmetry(0.7, 0.4, matrix), 0);
  EXPECT_EQ(matrix, counted());
}

TEST(Symmetry, GoesByTheValueOfTheNode) {
  Eigen::Matrix3d matrix = counted();
  EXPECT_GT(enforce_symmetry(0.7, 1e-10, matrix), 0);  // rounding of a node at zero
  matrix = counted();
  EXPECT_EQ(enforce_symmetry(0.7, 1e-8, matrix), 0);  // a node that is not at zero
  matrix = counted();
  EXPECT_EQ(enforce_symmetry(1e-8, 0.3, matrix), 0);
  matrix = counted();
  EXPECT_GT(enforce_symmetry(0.7, static_cast<double>(7) * kHalfPi / 7, matrix), 0);
}

TEST(Symmetry, ReportsWhatWasNotANumber) {
  Eigen::Matrix3d matrix = counted();
  matrix(0, 1) = std::nan("");
  EXPECT_TRUE(std::isnan(enforce_symmetry(0.7, 0, matrix)));
  EXPECT_EQ(matrix(0, 1), 0);
  EXPECT_EQ(matrix(2, 1), 0);
}

}  // namespace
}  // namespace ltc
