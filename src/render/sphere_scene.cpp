// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/sphere_scene.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/angle.h"
#include "render/tangent_frame.h"

namespace ltc {
namespace {

using Eigen::Vector3d;

constexpr double half_side = 1.6;  // of plane and sheet
constexpr double bend_radius = 1.5, bend_axis_height = -1;
constexpr double largest_bend = 60 * radians_per_degree;
constexpr double camera_elevation = 30 * radians_per_degree;

struct Ray {
  Vector3d from, direction;
};

// To the first point of a sphere or, without the ray's x, of a cylinder along x, about `center`;
// nothing where it misses.
std::optional<double> first_hit(const Ray& ray, const Vector3d& center, double radius, bool round) {
  const Vector3d mask(round ? 1 : 0, 1, 1);
  const Vector3d from = (ray.from - center).cwiseProduct(mask),
                 along = ray.direction.cwiseProduct(mask);
  const double towards = -from.dot(along) / along.squaredNorm();
  const double discriminant =
      towards * towards - (from.squaredNorm() - radius * radius) / along.squaredNorm();
  if (!(discriminant > 0))
    return std::nullopt;
  return towards - std::sqrt(discriminant);
}

ShadingPoint point_on(const Ray& ray, const Vector3d& position, const Eigen::Matrix3d& frame) {
  return {position, frame, frame * -ray.direction};
}

std::optional<ShadingPoint> on_sphere(const Ray& ray) {
  const auto distance = first_hit(ray, Vector3d::Zero(), 1, true);
  if (!distance)
    return std::nullopt;
  const Vector3d position = (ray.from + *distance * ray.direction).normalized();
  return point_on(ray, position, tangent_frame(position));
}

std::optional<ShadingPoint> on_plane(const Ray& ray) {
  const Vector3d position = ray.from - ray.from.y() / ray.direction.y() * ray.direction;
  if (std::abs(position.x()) > half_side || std::abs(position.z()) > half_side)
    return std::nullopt;
  Eigen::Matrix3d frame;
  frame << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return point_on(ray, {position.x(), 0, position.z()}, frame);
}

std::optional<ShadingPoint> on_sheet(const Ray& ray) {
  const auto distance = first_hit(ray, {0, bend_axis_height, 0}, bend_radius, false);
  if (!distance)
    return std::nullopt;
  const Vector3d position = ray.from + *distance * ray.direction;
  const double t = std::atan2(position.z(), position.y() - bend_axis_height);
  if (std::abs(position.x()) > half_side || std::abs(t) > largest_bend)
    return std::nullopt;
  const double cosine = std::cos(t), sine = std::sin(t);
  Eigen::Matrix3d frame;
  frame << 1, 0, 0, 0, sine, -cosine, 0, cosine, sine;
  return point_on(ray, {position.x(), bend_radius * cosine + bend_axis_height, bend_radius * sine},
                  frame);
}

// Through a point of the picture. The plane at distance 1 before the camera shows the outline of
// the unit sphere as a circle of radius 1/horizon.
Ray camera_ray(const SphereScene& scene, double x, double y) {
  const double distance = scene.camera_distance;
  const double horizon = std::sqrt(distance * distance - 1);  // from the camera to the outline
  const double scale = 1 / (horizon * scene.sphere_share);
  const double elevation = scene.shape == ObjectShape::sphere ? 0 : camera_elevation;
  const double cosine = std::cos(elevation), sine = std::sin(elevation);
  const Vector3d backwards(0, sine, cosine), upwards(0, cosine, -sine);
  const Vector3d direction = x * scale * Vector3d::UnitX() + y * scale * upwards - backwards;
  return {distance * backwards, direction.normalized()};
}

}  // namespace

Vector3d usual_light_position(ObjectShape shape) {
  return shape == ObjectShape::sphere ? Vector3d(1.0, 1.5, 2.1) : Vector3d(0, 1.5, -2);
}

Lobe ShadingPoint::lobe(double alpha_x, double alpha_y, const LobeModel& model) const {
  return {alpha_x, alpha_y, std::atan2(std::hypot(omega_v.x(), omega_v.y()), omega_v.z()),
          std::atan2(omega_v.y(), omega_v.x()), &model};
}

Light ShadingPoint::seen(const Light& light) const {
  Light seen = light;
  seen.center = to_tangent * (light.center - position);
  seen.half_u = to_tangent * light.half_u;
  seen.half_v = to_tangent * light.half_v;
  return seen;
}

std::optional<ShadingPoint> shading_point(const SphereScene& scene, double x, double y) {
  const Ray ray = camera_ray(scene, x, y);
  switch (scene.shape) {
    case ObjectShape::plane:
      return on_plane(ray);
    case ObjectShape::sheet:
      return on_sheet(ray);
    default:
      return on_sphere(ray);
  }
}

}  // namespace ltc
