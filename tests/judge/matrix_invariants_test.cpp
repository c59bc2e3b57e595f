// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/matrix_invariants.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "align/align.h"
#include "core/angle.h"
#include "support/wide.h"

namespace ltc {
namespace {

Eigen::Matrix3d turn(const Eigen::Vector3d& axis, double degrees) {
  return Eigen::AngleAxisd(radians_of_degrees(degrees), axis.normalized()).toRotationMatrix();
}

TEST(ConditionNumber, IsTheRatioOfTheSingularValues) {
  EXPECT_DOUBLE_EQ(condition_number(Eigen::Matrix3d::Identity()), 1);
  const Eigen::Matrix3d u = turn({1, 2, 3}, 40), v = turn({-1, 1, 0.5}, 100);
  // Singular values of rounding size relative to the largest: 1e-16 of 1e-10 is six digits.
  for (const double least : {0.5, 1e-4, 1e-10})
    EXPECT_NEAR(condition_number(u * Eigen::Vector3d(1, 0.7, least).asDiagonal() * v) * least, 1,
                1e-5);
}

// Over all condition numbers that an invertible matrix in double can have.
TEST(ConditionNumber, KeepsItsDigitsWhereTheEigenvaluesOfTheSquareDoNot) {
  const Eigen::Matrix3d u = turn({1, 2, 3}, 40), v = turn({-1, 1, 0.5}, 100);
  test::WorstError careful, naive;
  for (const double least : test::logarithmic(1e-12, 0.5, 24)) {
    const Eigen::Matrix3d matrix = u * Eigen::Vector3d(1, 0.7, least).asDiagonal() * v;
    careful.add((condition_number(matrix) * least - 1) * least);
    const Eigen::Vector3d squares =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix.transpose() * matrix).eigenvalues();
    naive.add((std::sqrt(squares.z() / squares.x()) * least - 1) * least);
  }
  // Relative, over the condition number: the entries of the matrix are rounded, which moves its
  // least singular value by 2^-53 of the largest. Some ten such roundings.
  test::expect_only_the_careful_one_within(16 * test::kDoubleRounding, careful, naive);
}

TEST(ConditionNumber, IsInfiniteForSingularAndNanForNan) {
  Eigen::Matrix3d matrix = turn({1, 2, 3}, 40);
  matrix.row(1).setZero();
  EXPECT_GT(condition_number(matrix), 1e15);
  EXPECT_EQ(condition_number(Eigen::Matrix3d::Zero()), std::numeric_limits<double>::infinity());
  matrix(0, 0) = std::nan("");
  EXPECT_TRUE(std::isnan(condition_number(matrix)));
}

TEST(Misalignment, IsTheAngleThatAlignmentTurnsBy) {
  Eigen::Matrix3d lobe;
  lobe << 0.5, 0.05, -0.3, 0, 0.3, -0.4, 0.2, 0.1, 0.8;
  const Eigen::Matrix3d aligned = align(lobe);
  // What alignment leaves is below a tenth of a milliradian, 0.006 degrees.
  EXPECT_LT(misalignment_degrees(aligned), 0.006);
  for (const double degrees : {-170.0, -30.0, 1.0, 90.0})
    EXPECT_NEAR(misalignment_degrees(aligned * turn({0, 0, 1}, degrees)), std::abs(degrees), 0.02)
        << degrees;
}

TEST(Misalignment, AReflectionCountsAsHalfATurn) {
  const Eigen::Vector3d mirror(1, -1, 1);
  EXPECT_EQ(misalignment_degrees(Eigen::Matrix3d(mirror.asDiagonal())), 180);
}

}  // namespace
}  // namespace ltc
