// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/symmetry.h"

#include <cmath>
#include <numbers>

namespace ltc {

bool looks_upward(double theta_radians) {
  return std::abs(theta_radians) <= symmetry_tolerance;
}

bool looks_along_x(double theta_radians, double phi_radians) {
  return looks_upward(theta_radians) || std::abs(phi_radians) <= symmetry_tolerance;
}

bool looks_along_y(double theta_radians, double phi_radians) {
  return looks_upward(theta_radians) ||
         std::abs(phi_radians - std::numbers::pi / 2) <= symmetry_tolerance;
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

}  // namespace ltc
