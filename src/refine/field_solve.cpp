// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/field_solve.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "refine/field_kernels.h"

namespace ltc {
namespace {

// A factor's, and a product's.
constexpr Eigen::Index block = 48, wide_block = 192;

// `count` rows of a matrix from one on, and of these `depth` columns from another on.
kernels::RowsOf<double> rows_of(const Eigen::MatrixXd& matrix, Eigen::Index row, Eigen::Index count,
                                Eigen::Index column, Eigen::Index depth) {
  return {matrix.data() + column * matrix.rows() + row, static_cast<std::size_t>(count),
          static_cast<std::size_t>(depth), static_cast<std::size_t>(matrix.rows())};
}

// Adds to a part of a matrix that begins at an entry.
void add(const kernels::RowsOf<double>& a, const kernels::RowsOf<double>& b, double scale,
         Eigen::MatrixXd& to, Eigen::Index row, Eigen::Index column) {
  kernels::add_products(a, nullptr, b, scale, &to(row, column), static_cast<std::size_t>(to.rows()),
                        kernels::Products::all);
}

// Adds the upper half of a matrix times its transpose to a symmetric one, and makes the lower one
// alike. Of an upper triangular one the zeros are left out.
enum class Shape { full, upper };
void add_squared(const Eigen::MatrixXd& matrix, Shape shape, double scale, Eigen::MatrixXd& to) {
  const Eigen::Index n = matrix.rows();
  for (Eigen::Index j = 0; j < n; j += wide_block) {
    const Eigen::Index count = std::min(wide_block, n - j);
    const Eigen::Index first = shape == Shape::upper ? j : 0, depth = matrix.cols() - first;
    add(rows_of(matrix, 0, j + count, first, depth), rows_of(matrix, j, count, first, depth), scale,
        to, 0, j);
  }
  to.triangularView<Eigen::StrictlyLower>() = to.transpose();
}

}  // namespace

CholeskyFactor::CholeskyFactor(Eigen::MatrixXd matrix) : lower_(std::move(matrix)) {
  const Eigen::Index n = lower_.rows();
  for (Eigen::Index j = 0; j < n; j += block) {
    const Eigen::Index count = std::min(block, n - j), rest = n - j - count;
    if (j > 0)
      add(rows_of(lower_, j, n - j, 0, j), rows_of(lower_, j, count, 0, j), -1, lower_, j, j);
    const Eigen::LLT<Eigen::MatrixXd> own(lower_.block(j, j, count, count));
    lower_.block(j, j, count, count) = own.matrixL();
    if (rest > 0)
      own.matrixU().solveInPlace<Eigen::OnTheRight>(lower_.block(j + count, j, rest, count));
  }
}

Eigen::VectorXd CholeskyFactor::solve(const Eigen::VectorXd& right) const {
  const auto lower = lower_.triangularView<Eigen::Lower>();
  return lower.transpose().solve(lower.solve(right));
}

// Of Y L^T = 1 a block of columns after the other, and Y Y^T.
Eigen::MatrixXd CholeskyFactor::inverse() const {
  const Eigen::Index n = lower_.rows();
  Eigen::MatrixXd upper = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; j += block) {
    const Eigen::Index count = std::min(block, n - j);
    upper.block(j, j, count, count).setIdentity();
    for (Eigen::Index row = 0; row < j; row += block)
      add(rows_of(upper, row, block, row, j - row), rows_of(lower_, j, count, row, j - row), -1,
          upper, row, j);
    lower_.block(j, j, count, count)
        .triangularView<Eigen::Lower>()
        .transpose()
        .solveInPlace<Eigen::OnTheRight>(upper.block(0, j, j + count, count));
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  add_squared(upper, Shape::upper, 1, result);
  return result;
}

Eigen::MatrixXd squared(const Eigen::MatrixXd& matrix) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(matrix.rows(), matrix.rows());
  add_squared(matrix, Shape::full, 1, result);
  return result;
}

void subtract_squared(const Eigen::MatrixXd& taken, Eigen::MatrixXd& from) {
  add_squared(taken, Shape::full, -1, from);
}

}  // namespace ltc
