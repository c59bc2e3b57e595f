// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "ltc/sphere_clip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ltc {

double clipped_sphere_factor(double cos_omega, double form_factor) {
  using std::numbers::pi;
  const double sin2_sigma = std::clamp(form_factor, 0.0, 1.0);
  const double sin_sigma = std::sqrt(sin2_sigma), cos_sigma = std::sqrt(1 - sin2_sigma);
  const double c = std::clamp(cos_omega, -1.0, 1.0), s = std::sqrt(1 - c * c);
  if (c >= sin_sigma)
    return c;
  if (c <= -sin_sigma)
    return 0;
  // The horizon cuts the sphere: sin(gamma) = cos(sigma) / sin(omega).
  const double sin_gamma = std::min(cos_sigma / s, 1.0);
  const double gamma = std::asin(sin_gamma), cos_gamma = std::sqrt(1 - sin_gamma * sin_gamma);
  const double g = -2 * s * cos_sigma * cos_gamma + pi / 2 - gamma + sin_gamma * cos_gamma;
  const double h = c * (cos_gamma * std::sqrt(std::max(sin2_sigma - cos_gamma * cos_gamma, 0.0)) +
                        sin2_sigma * std::asin(std::min(cos_gamma / sin_sigma, 1.0)));
  return (c >= 0 ? pi * c * sin2_sigma + g - h : g + h) / (pi * sin2_sigma);
}

}  // namespace ltc
