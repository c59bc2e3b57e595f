// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/field_solve.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace ltc {
namespace {

// Sizes within a block, of whole blocks, and of blocks and a part of one. A condition number of
// some thousands leaves twelve digits.
TEST(FieldSolve, SolutionsAndInversesAreThoseOfTheMatrix) {
  for (const Eigen::Index n : {1, 5, 48, 96, 200, 400}) {
    const Eigen::MatrixXd values = Eigen::MatrixXd::Random(n, 2 * n + 7);
    const Eigen::MatrixXd matrix = squared(values);
    EXPECT_LT((matrix - values * values.transpose()).cwiseAbs().maxCoeff(), 1e-11) << n;
    Eigen::MatrixXd less = matrix;
    subtract_squared(values, less);
    EXPECT_LT(less.cwiseAbs().maxCoeff(), 1e-11) << n;
    const Eigen::VectorXd right = Eigen::VectorXd::Random(n);
    const CholeskyFactor factor(matrix);
    EXPECT_LT((matrix * factor.solve(right) - right).cwiseAbs().maxCoeff(), 1e-10) << n;
    const Eigen::MatrixXd inverse = factor.inverse();
    EXPECT_LT((matrix * inverse - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 1e-10)
        << n;
    EXPECT_EQ(inverse, inverse.transpose()) << n;
  }
}

TEST(FieldSolve, OnlyTheLowerHalfIsRead) {
  Eigen::MatrixXd matrix = squared(Eigen::MatrixXd::Random(100, 300));
  const Eigen::VectorXd right = Eigen::VectorXd::Random(100);
  const Eigen::VectorXd expected = CholeskyFactor(matrix).solve(right);
  matrix.triangularView<Eigen::StrictlyUpper>().setConstant(42);
  EXPECT_EQ(CholeskyFactor(matrix).solve(right), expected);
}

}  // namespace
}  // namespace ltc
