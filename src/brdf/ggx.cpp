// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The anisotropic GGX lobe: evaluation and sampling without cancellation.
#include "brdf/ggx.h"

#include <cmath>
#include <numbers>

#include "brdf/microfacet-inl.h"

namespace ltc {
namespace {

double square(double x) {
  return x * x;
}

// (alpha_x x)^2 + (alpha_y y)^2: z^2 times the slope variance along the direction.
double stretched_sine_squared(double alpha_x, double alpha_y, const Eigen::Vector3d& omega) {
  return square(alpha_x * omega.x()) + square(alpha_y * omega.y());
}

// vz (1 + Lambda(v)) = (vz + sqrt(vz^2 + s^2))/2.
double visible_area(const Lobe& lobe) {
  const Eigen::Vector3d v = lobe.omega_v();
  const double s_squared = stretched_sine_squared(lobe.alpha_x, lobe.alpha_y, v);
  return (v.z() + std::sqrt(square(v.z()) + s_squared)) / 2;
}

}  // namespace

// With h = H/|H| equation (4) reads |H|^4 / (pi ax ay ((Hx/ax)^2 + (Hy/ay)^2 + Hz^2)^2): no
// normalised z^2 = 1 - x^2 - y^2 is ever formed, and Hx, Hy keep their digits.
double ggx_ndf(double alpha_x, double alpha_y, const Eigen::Vector3d& omega_h) {
  if (!(omega_h.z() > 0))
    return 0;
  const double stretched =
      square(omega_h.x() / alpha_x) + square(omega_h.y() / alpha_y) + square(omega_h.z());
  return square(omega_h.squaredNorm() / stretched) / (std::numbers::pi * alpha_x * alpha_y);
}

// Equation (5) with s^2 = ax^2 x^2 + ay^2 y^2:
//   (-1 + sqrt(1 + s^2/z^2))/2 = s^2 / (2 |z| (|z| + sqrt(z^2 + s^2))).
double ggx_lambda(double alpha_x, double alpha_y, const Eigen::Vector3d& omega) {
  const double s_squared = stretched_sine_squared(alpha_x, alpha_y, omega);
  const double z = std::abs(omega.z());
  return s_squared / (2 * z * (z + std::sqrt(z * z + s_squared)));
}

template class MicrofacetSampler<GgxSampler, ggx_ndf, ggx_lambda>;

GgxSampler::GgxSampler(const Lobe& lobe)
    : MicrofacetSampler(lobe, visible_area(lobe)),
      stretched_v_(
          Eigen::Vector3d(alpha_x() * omega_v().x(), alpha_y() * omega_v().y(), omega_v().z())
              .normalized()),
      one_minus_stretched_z_((square(stretched_v_.x()) + square(stretched_v_.y())) /
                             (1 + stretched_v_.z())) {}

// The cap is the part of the unit sphere with z > -v_z (v the stretched view direction). For a
// point c uniform on it c + v has the direction of a visible normal at unit roughness, and
// c_z + v_z = (1 - u)(1 + v_z), 1 - c_z = u (1 + v_z) and 1 + c_z = (c_z + v_z) + (1 - v_z) need no
// subtraction of near numbers.
Eigen::Vector3d GgxSampler::visible_normal(double cos_azimuth, double sin_azimuth,
                                           double u_height) const {
  const double depth = u_height * (1 + stretched_v_.z());
  const double above_rim = (1 - u_height) * (1 + stretched_v_.z());
  const double sine = std::sqrt(depth * (above_rim + one_minus_stretched_z_));
  return Eigen::Vector3d(alpha_x() * (sine * cos_azimuth + stretched_v_.x()),
                         alpha_y() * (sine * sin_azimuth + stretched_v_.y()), above_rim)
      .normalized();
}

}  // namespace ltc
