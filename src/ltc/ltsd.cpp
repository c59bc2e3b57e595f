// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Linearly transformed spherical distributions.
#include "ltc/ltsd.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "ltc/polygon.h"

namespace ltc {
namespace {

constexpr double kPi = std::numbers::pi;

// Cosine and sine of the angle to z within which a share u of the distribution lies. Near the axis
// (1 - z)(1 + z) has the digits that z leaves of u, so the sines are written in u itself.
struct Polar {
  double cosine, sine;
};
Polar sample_polar(Original original, double u) {
  switch (original) {
    case Original::uniform_sphere:
      return {1 - 2 * u, 2 * std::sqrt(u * (1 - u))};
    case Original::uniform_hemisphere:
      return {1 - u, std::sqrt(u * (2 - u))};
    case Original::clamped_cosine:
      return {std::sqrt(1 - u), std::sqrt(u)};
    case Original::squared_clamped_cosine: {
      // 1 - z = (1 - z^3)/(1 + z + z^2).
      const double z = std::cbrt(1 - u);
      return {z, std::sqrt(u * (1 + z) / (1 + z + z * z))};
    }
  }
  throw InputError("unknown original distribution");
}

double integrate_original(Original original, std::span<const Eigen::Vector3d> vertices) {
  switch (original) {
    case Original::uniform_sphere:
      return polygon_solid_angle(vertices) / (4 * kPi);
    case Original::uniform_hemisphere:
      return polygon_solid_angle(clip_to_upper_hemisphere(vertices)) / (2 * kPi);
    case Original::clamped_cosine:
      return polygon_cosine_integral(clip_to_upper_hemisphere(vertices)) / kPi;
    case Original::squared_clamped_cosine:
      return polygon_squared_cosine_integral(clip_to_upper_hemisphere(vertices)) * 3 / (2 * kPi);
  }
  throw InputError("unknown original distribution");
}

}  // namespace

double original_density(Original original, const Eigen::Vector3d& omega_o) {
  const double z = omega_o.z();
  if (original == Original::uniform_sphere)
    return 1 / (4 * kPi);
  if (z < 0)
    return 0;
  switch (original) {
    case Original::uniform_hemisphere:
      return 1 / (2 * kPi);
    case Original::clamped_cosine:
      return z / kPi;
    default:
      return 3 * z * z / (2 * kPi);
  }
}

Eigen::Vector3d sample_original(Original original, double u_height, double u_azimuth) {
  const auto [cosine, sine] = sample_polar(original, u_height);
  const double azimuth = 2 * kPi * u_azimuth;
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

bool is_invertible(const Eigen::Matrix3d& matrix) {
  return matrix.allFinite() && matrix.determinant() != 0 && matrix.inverse().allFinite();
}

LinearlyTransformed::LinearlyTransformed(const Eigen::Matrix3d& matrix, Original original)
    : matrix_(matrix),
      inverse_(matrix.inverse()),
      inverse_determinant_(inverse_.determinant()),
      original_(original) {
  if (!matrix.allFinite() || !inverse_.allFinite() || inverse_determinant_ == 0)
    throw InputError(
        fmt::format("matrix of a linearly transformed distribution has determinant {}: it must be "
                    "finite and have an inverse",
                    matrix.determinant()));
}

double LinearlyTransformed::density(const Eigen::Vector3d& omega) const {
  const Eigen::Vector3d transformed = inverse_ * omega;
  const double length = transformed.norm();
  return original_density(original_, transformed / length) * std::abs(inverse_determinant_) /
         (length * length * length);
}

Eigen::Vector3d LinearlyTransformed::sample(double u_height, double u_azimuth) const {
  return (matrix_ * sample_original(original_, u_height, u_azimuth)).normalized();
}

double LinearlyTransformed::integrate_polygon(std::span<const Eigen::Vector3d> vertices) const {
  std::vector<Eigen::Vector3d> transformed;
  transformed.reserve(vertices.size());
  for (const Eigen::Vector3d& vertex : vertices)
    transformed.push_back(inverse_ * vertex);
  const double integral = integrate_original(original_, transformed);
  return inverse_determinant_ < 0 ? -integral : integral;
}

double share_below_horizon(const Eigen::Matrix3d& matrix) {
  const Eigen::RowVector3d up = matrix.row(2);
  const double across = std::hypot(up.x(), up.y()), length = std::hypot(across, up.z());
  // (1 - cos(gamma))/2 is sin^2(gamma)/2/(1 + cos(gamma)), which keeps the digits of a small share.
  const double cosine = up.z() / length, sine = across / length;
  return cosine < 0 ? (1 - cosine) / 2 : sine * sine / (2 * (1 + cosine));
}

}  // namespace ltc
