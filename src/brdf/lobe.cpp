// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "brdf/lobe.h"

#include <cmath>

namespace ltc {
namespace {

// A sine or cosine below the rounding error of its argument is zero.
double without_rounding(double sine) {
  return std::abs(sine) < 1e-15 ? 0.0 : sine;
}

}  // namespace

Eigen::Vector3d Lobe::omega_v() const {
  const double sin_theta = std::sin(theta_radians);
  return {sin_theta * without_rounding(std::cos(phi_radians)),
          sin_theta * without_rounding(std::sin(phi_radians)), std::cos(theta_radians)};
}

Eigen::Vector3d Lobe::mirror() const {
  const Eigen::Vector3d v = omega_v();
  return {-v.x(), -v.y(), v.z()};
}

}  // namespace ltc
