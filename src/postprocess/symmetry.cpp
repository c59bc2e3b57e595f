// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The zeros of equation (16).
#include "postprocess/symmetry.h"

#include <cmath>
#include <numbers>

namespace ltc {

bool looks_upward(double theta_radians) {
  return std::abs(theta_radians) <= kSymmetryTolerance;
}

bool looks_along_x(double theta_radians, double phi_radians) {
  return looks_upward(theta_radians) || std::abs(phi_radians) <= kSymmetryTolerance;
}

bool looks_along_y(double theta_radians, double phi_radians) {
  return looks_upward(theta_radians) ||
         std::abs(phi_radians - std::numbers::pi / 2) <= kSymmetryTolerance;
}

Eigen::Matrix<bool, 3, 3> symmetry_zeros(double theta_radians, double phi_radians) {
  Eigen::Matrix<bool, 3, 3> zeros = Eigen::Matrix<bool, 3, 3>::Constant(false);
  // Mirroring along an axis leaves the lobe as it is: nothing mixes that axis with the others.
  auto separate = [&](int axis) {
    for (int other = 0; other < 3; ++other)
      if (other != axis)
        zeros(axis, other) = zeros(other, axis) = true;
  };
  if (looks_along_x(theta_radians, phi_radians))
    separate(1);
  if (looks_along_y(theta_radians, phi_radians))
    separate(0);
  return zeros;
}

double enforce_symmetry(double theta_radians, double phi_radians, Eigen::Matrix3d& matrix) {
  const Eigen::Matrix<bool, 3, 3> zeros = symmetry_zeros(theta_radians, phi_radians);
  const double largest = zeros.select(matrix.cwiseAbs(), 0.0).maxCoeff<Eigen::PropagateNaN>();
  matrix = zeros.select(0.0, matrix).eval();
  return largest;
}

}  // namespace ltc
