// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/sphere_scene.h"

#include <Eigen/Geometry>
#include <cmath>

namespace ltc {
namespace {

const Eigen::Vector3d up = Eigen::Vector3d::UnitY();

// Rows east, north and out.
Eigen::Matrix3d tangent_frame(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d along_parallel = up.cross(normal);
  const double length = along_parallel.norm();
  // At a pole every direction is south, or north; one is taken.
  const Eigen::Vector3d east =
      length > 0 ? (along_parallel / length).eval() : Eigen::Vector3d::UnitX();
  Eigen::Matrix3d frame;
  frame << east.transpose(), normal.cross(east).transpose(), normal.transpose();
  return frame;
}

}  // namespace

Eigen::Vector3d RectangleLight::normal() const {
  return half_u.cross(half_v).normalized();
}

std::array<Eigen::Vector3d, 4> RectangleLight::corners() const {
  return {center - half_u - half_v, center - half_u + half_v, center + half_u + half_v,
          center + half_u - half_v};
}

RectangleLight SphereScene::facing_origin(const Eigen::Vector3d& center, double half_width,
                                          double half_height) {
  const Eigen::Matrix3d frame = tangent_frame(-center.normalized());
  return {center, half_width * frame.row(0).transpose(), half_height * frame.row(1).transpose()};
}

Lobe ShadingPoint::lobe(double alpha_x, double alpha_y, const LobeModel& model) const {
  return {alpha_x, alpha_y, std::atan2(std::hypot(omega_v.x(), omega_v.y()), omega_v.z()),
          std::atan2(omega_v.y(), omega_v.x()), &model};
}

RectangleLight ShadingPoint::seen(const RectangleLight& light) const {
  return {to_tangent * (light.center - position), to_tangent * light.half_u,
          to_tangent * light.half_v};
}

std::optional<ShadingPoint> shading_point(const SphereScene& scene, double x, double y) {
  const double distance = scene.camera_distance;
  const double horizon = std::sqrt(distance * distance - 1);  // from the camera to the outline
  // The plane at distance 1 before the camera shows the outline as a circle of radius 1/horizon.
  const double scale = 1 / (horizon * scene.sphere_share);
  const Eigen::Vector3d camera(0, 0, distance);
  const Eigen::Vector3d ray = Eigen::Vector3d(x * scale, y * scale, -1).normalized();
  const double towards = -camera.dot(ray);  // to the point nearest the centre
  const double discriminant = towards * towards - horizon * horizon;
  if (!(discriminant > 0))
    return std::nullopt;
  ShadingPoint point;
  point.position = (camera + (towards - std::sqrt(discriminant)) * ray).normalized();
  point.to_tangent = tangent_frame(point.position);
  point.omega_v = point.to_tangent * -ray;
  return point;
}

}  // namespace ltc
