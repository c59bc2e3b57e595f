// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A field's normal equations, solved: Cholesky's factor of a dense matrix of more than a thousand
// rows, in blocks whose products are those of field_kernels.h. Eigen's are for the least vector
// unit that there is.
#pragma once

#include <Eigen/Core>

namespace ltc {

// Of a positive definite matrix, of which the lower half is read; another one's solutions are
// without meaning.
class CholeskyFactor {
 public:
  explicit CholeskyFactor(Eigen::MatrixXd matrix);

  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  Eigen::MatrixXd inverse() const;

 private:
  Eigen::MatrixXd lower_;  // L of L L^T; what is above the diagonal does not count
};

// A matrix times its own transpose.
Eigen::MatrixXd squared(const Eigen::MatrixXd& matrix);

// Takes that away from a matrix.
void subtract_squared(const Eigen::MatrixXd& taken, Eigen::MatrixXd& from);

}  // namespace ltc
