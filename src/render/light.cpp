// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/light.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "ltc/disk.h"
#include "render/tangent_frame.h"

namespace ltc {
namespace {

constexpr double star_outer = 1.1, star_inner = 0.45;

// Clockwise from v, as the corners of a rectangle.
std::array<Eigen::Vector2d, 10> star_outline() {
  std::array<Eigen::Vector2d, 10> outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const double angle = std::numbers::pi / 5 * static_cast<double>(i);
    const double radius = i % 2 ? star_inner / star_outer : 1;
    outline[i] = {radius * std::sin(angle), radius * std::cos(angle)};
  }
  return outline;
}

// What a tube shows is as wide as its tangent planes through the origin are apart.
std::optional<Light> strip_of(const Light& line) {
  const double half_length = line.half_u.norm(), radius = line.half_v.norm();
  const Eigen::Vector3d along = line.half_u / half_length;
  const double at = line.center.dot(along);  // from the origin's foot on the straight
  const Eigen::Vector3d foot = line.center - at * along;
  const double distance = foot.norm();
  if (!(distance > radius)) {
    if (std::abs(at) <= half_length)
      throw InputError(
          fmt::format("a line light of radius {:.4g} at distance {:.4g} of a point; it must not "
                      "touch the object",
                      radius, distance));
    return std::nullopt;
  }
  const double ratio = radius / distance;
  Light strip = line;
  strip.shape = LightShape::rectangle;
  // half_u x half_v points from the light to the origin.
  strip.half_v = radius / std::sqrt((1 - ratio) * (1 + ratio)) * (-foot / distance).cross(along);
  return strip;
}

}  // namespace

Eigen::Vector3d Light::normal() const {
  return half_u.cross(half_v).normalized();
}

std::span<const Eigen::Vector2d> Light::outline() const {
  static const std::array<Eigen::Vector2d, 4> square{{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}};
  static const std::array<Eigen::Vector2d, 10> star = star_outline();
  if (shape == LightShape::rectangle)
    return square;
  if (shape == LightShape::star)
    return star;
  return {};
}

std::vector<Eigen::Vector3d> Light::corners() const {
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Vector2d& corner : outline())
    corners.push_back(center + corner.x() * half_u + corner.y() * half_v);
  return corners;
}

bool Light::emits_to_origin() const {
  return two_sided || shape == LightShape::sphere || shape == LightShape::line ||
         normal().dot(center) < 0;
}

bool Light::reaches_above_horizon() const {
  if (shape == LightShape::sphere)
    return center.z() + half_u.norm() > 0;
  if (shape == LightShape::line)
    return center.z() + std::abs(half_u.z()) + half_v.norm() > 0;
  return center.z() + std::abs(half_u.z()) + std::abs(half_v.z()) > 0;
}

std::optional<Light> Light::flat() const {
  if (shape == LightShape::line)
    return strip_of(*this);
  if (shape != LightShape::sphere)
    return *this;
  if (!(center.norm() > half_u.norm()))
    throw InputError(
        fmt::format("a sphere light of radius {:.4g} at distance {:.4g} of a point; it must not "
                    "touch the object",
                    half_u.norm(), center.norm()));
  const Ellipse disk = disk_of_sphere(center, half_u.norm());
  // Towards the origin.
  return Light{disk.center, disk.half_v, disk.half_u, LightShape::disk};
}

Light light_facing_origin(const Eigen::Vector3d& center, double half_width, double half_height) {
  const Eigen::Matrix3d frame = tangent_frame(-center.normalized());
  return {center, half_width * frame.row(0).transpose(), half_height * frame.row(1).transpose()};
}

Light standard_light(LightShape shape, const Eigen::Vector3d& center, double size) {
  const auto of = [&](double half_width, double half_height) {
    Light light = light_facing_origin(center, half_width * size, half_height * size);
    light.shape = shape;
    return light;
  };
  switch (shape) {
    case LightShape::star:
      return of(star_outer, star_outer);
    case LightShape::disk:
      return of(0.8, 0.8);
    case LightShape::sphere:
      return of(0.6, 0.6);
    case LightShape::line:
      return of(1.1, 0.03);
    default:
      return of(1.1, 0.7);
  }
}

}  // namespace ltc
