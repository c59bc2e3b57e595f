// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A field's normal equations, solved: Cholesky's factor of a dense matrix of more than a thousand
// rows, in blocks whose products are those of field_kernels.h. Eigen's are for the least vector
// unit that there is.
#pragma once

#include <Eigen/Core>

namespace ltc {

// Of a positive definite matrix, of which the upper half is read; another one's solutions are
// without meaning.
class CholeskyFactor {
 public:
  explicit CholeskyFactor(Eigen::MatrixXd matrix);

  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  Eigen::MatrixXd inverse() const;

 private:
  Eigen::MatrixXd upper_;  // U of U^T U; what is below the diagonal does not count
};

// rows^T rows.
Eigen::MatrixXd squared(const Eigen::MatrixXd& rows);

}  // namespace ltc
