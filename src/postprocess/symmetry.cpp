// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "postprocess/symmetry.h"

namespace ltc {

double enforce_symmetry(double theta_radians, double phi_radians, Eigen::Matrix3d& matrix) {
  const Eigen::Matrix<bool, 3, 3> zeros = symmetry_zeros(theta_radians, phi_radians);
  const double largest = zeros.select(matrix.cwiseAbs(), 0.0).maxCoeff<Eigen::PropagateNaN>();
  matrix = zeros.select(0.0, matrix).eval();
  return largest;
}

}  // namespace ltc
