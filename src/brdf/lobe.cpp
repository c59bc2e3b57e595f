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

// 1 - x^2/(1 + z) = (y^2 + z + z^2)/(1 + z): of a grazing view nothing else would be left than the
// rounding of 1.
Eigen::Matrix3d mirror_rotation(const Eigen::Vector3d& omega_v) {
  const double x = omega_v.x(), y = omega_v.y(), z = omega_v.z();
  const double s = 1 / (1 + z);
  Eigen::Matrix3d rotation;
  rotation << z + y * y * s, -x * y * s, -x,  //
      -x * y * s, z + x * x * s, -y,          //
      x, y, z;
  return rotation;
}

}  // namespace ltc
