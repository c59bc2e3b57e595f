// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/field_solve.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "refine/field_kernels.h"

namespace ltc {
namespace {

constexpr Eigen::Index block = 64;

// `count` columns of a matrix from one on, and of these `rows` rows from another on.
kernels::ColumnsOf<double> columns_of(const Eigen::MatrixXd& matrix, Eigen::Index row,
                                      Eigen::Index rows, Eigen::Index column, Eigen::Index count) {
  return {matrix.data() + column * matrix.rows() + row, static_cast<std::size_t>(rows),
          static_cast<std::size_t>(count), static_cast<std::size_t>(matrix.rows())};
}

// The upper half of the product of a matrix's transpose and itself, and with it the lower one. Of
// a lower triangular one the zeros are left out.
enum class Shape { full, lower };
Eigen::MatrixXd transposed_times_itself(const Eigen::MatrixXd& matrix, Shape shape) {
  const Eigen::Index n = matrix.cols();
  Eigen::MatrixXd result(n, n);
  for (Eigen::Index j = 0; j < n; j += block) {
    const Eigen::Index count = std::min(block, n - j), first = shape == Shape::lower ? j : 0;
    const Eigen::Index rows = matrix.rows() - first;
    kernels::multiply_transposed(columns_of(matrix, first, rows, 0, j + count),
                                 columns_of(matrix, first, rows, j, count), &result(0, j),
                                 static_cast<std::size_t>(n));
  }
  result.triangularView<Eigen::StrictlyLower>() = result.transpose();
  return result;
}

}  // namespace

CholeskyFactor::CholeskyFactor(Eigen::MatrixXd matrix) : upper_(std::move(matrix)) {
  const Eigen::Index n = upper_.rows();
  Eigen::MatrixXd product(block, n);
  for (Eigen::Index j = 0; j < n; j += block) {
    const Eigen::Index count = std::min(block, n - j), rest = n - j - count;
    if (j > 0) {
      kernels::multiply_transposed(columns_of(upper_, 0, j, j, count),
                                   columns_of(upper_, 0, j, j, n - j), product.data(),
                                   static_cast<std::size_t>(block));
      upper_.block(j, j, count, n - j) -= product.topLeftCorner(count, n - j);
    }
    const Eigen::LLT<Eigen::MatrixXd, Eigen::Upper> own(upper_.block(j, j, count, count));
    upper_.block(j, j, count, count) = own.matrixU();
    if (rest > 0)
      own.matrixU().transpose().solveInPlace(upper_.block(j, j + count, count, rest));
  }
}

Eigen::VectorXd CholeskyFactor::solve(const Eigen::VectorXd& right) const {
  const auto upper = upper_.triangularView<Eigen::Upper>();
  return upper.solve(upper.transpose().solve(right));
}

Eigen::MatrixXd CholeskyFactor::inverse() const {
  const Eigen::Index n = upper_.rows();
  // U^-T, a block of rows after the other.
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(n, n), product(block, block);
  for (Eigen::Index j = 0; j < n; j += block) {
    const Eigen::Index count = std::min(block, n - j);
    lower.block(j, j, count, count).setIdentity();
    for (Eigen::Index column = 0; column < j; column += block) {
      kernels::multiply_transposed(columns_of(upper_, column, j - column, j, count),
                                   columns_of(lower, column, j - column, column, block),
                                   product.data(), static_cast<std::size_t>(block));
      lower.block(j, column, count, block) = -product.topRows(count);
    }
    upper_.block(j, j, count, count)
        .triangularView<Eigen::Upper>()
        .transpose()
        .solveInPlace(lower.block(j, 0, count, j + count));
  }
  return transposed_times_itself(lower, Shape::lower);
}

Eigen::MatrixXd squared(const Eigen::MatrixXd& rows) {
  return transposed_times_itself(rows, Shape::full);
}

}  // namespace ltc
