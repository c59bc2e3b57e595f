// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a stored matrix must be.
#include "postprocess/normalise.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/error.h"
#include "statistics.h"

namespace ltc {
namespace {

bool is_float(const Eigen::Matrix3d& matrix) {
  return matrix == matrix.cast<float>().cast<double>();
}

TEST(Normalise, ThirdColumnHasUnitLengthInFloat) {
  test::Uniform uniform(8);
  int tried = 0;
  while (tried < 500) {
    const Eigen::Matrix3d matrix =
        100 * Eigen::Matrix3d::NullaryExpr([&] { return 2 * uniform() - 1; });
    if (matrix.determinant() <= 0)
      continue;
    ++tried;
    const Eigen::Matrix3d normalised = normalise(Storage::matrix, matrix);
    EXPECT_TRUE(is_float(normalised));
    EXPECT_NEAR(normalised.col(2).norm(), 1, 1e-6);
    EXPECT_GT(normalised.determinant(), 0);
    EXPECT_TRUE(normalised.isApprox(matrix / matrix.col(2).norm(), 1e-6));
  }
}

TEST(Normalise, KeepsThePositiveDeterminantOfANearlySingularMatrix) {
  // The second column is the first but for 1e-8, which rounding wipes out or turns over.
  test::Uniform uniform(9);
  int turned_over = 0;
  for (int i = 0; i < 500; ++i) {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::NullaryExpr([&] { return 2 * uniform() - 1; });
    matrix.col(1) = matrix.col(0) + 1e-8 * matrix.col(1);
    matrix.col(2).normalize();
    if (matrix.determinant() < 0)
      matrix.col(1) = 2 * matrix.col(0) - matrix.col(1);
    if (!(matrix.determinant() > 0))
      continue;
    turned_over += matrix.cast<float>().cast<double>().determinant() <= 0;
    const Eigen::Matrix3d normalised = normalise(Storage::matrix, matrix);
    EXPECT_TRUE(is_float(normalised));
    EXPECT_GT(normalised.determinant(), 0);
    EXPECT_NEAR(normalised.col(2).norm(), 1, 1e-6);
    EXPECT_TRUE(normalised.isApprox(matrix, 2e-6));
  }
  EXPECT_GT(turned_over, 50);  // or this shows nothing
}

TEST(Normalise, KeepsZeros) {
  Eigen::Matrix3d matrix;
  matrix << 0.3, 0, -2, 0, 0.2, 0, 0.5, 0, 2;
  const Eigen::Matrix3d normalised = normalise(Storage::matrix, matrix);
  for (int i = 0; i < 9; ++i)
    EXPECT_EQ(normalised(i) == 0, matrix(i) == 0);
}

TEST(Normalise, RefusesWhatCannotBeStored) {
  EXPECT_THROW(normalise(Storage::matrix, Eigen::Matrix3d::Zero()), InputError);
  EXPECT_THROW(normalise(Storage::matrix, -Eigen::Matrix3d::Identity()), InputError);
  EXPECT_THROW(normalise(Storage::matrix, Eigen::Matrix3d::Constant(std::nan(""))), InputError);
  // Positive in double, but zero in float and every neighbour of it.
  EXPECT_THROW(normalise(Storage::matrix, Eigen::Vector3d(1e-60, 1, 1).asDiagonal()), CheckFailure);
}

}  // namespace
}  // namespace ltc
