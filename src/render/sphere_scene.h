// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What is rendered: a sphere under a rectangular light, seen by a pinhole camera.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "brdf/ggx.h"

namespace ltc {

// Emits radiance 1 from one side, that which half_u x half_v points to. The half sides are
// perpendicular.
struct RectangleLight {
  Eigen::Vector3d center, half_u, half_v;

  double area() const { return 4 * half_u.norm() * half_v.norm(); }
  Eigen::Vector3d normal() const;
  // Counter-clockwise as ltc/polygon.h has it, for a point at the origin that the light reaches.
  std::array<Eigen::Vector3d, 4> corners() const;
  // Whether the side that emits faces the origin.
  bool faces_origin() const { return normal().dot(center) < 0; }
};

// World: the sphere has radius 1 and its centre at the origin; y is up, and the camera looks along
// -z from (0, 0, camera_distance).
struct SphereScene {
  // Up, to the right and before the sphere, turned towards it.
  RectangleLight light = facing_origin({1.0, 1.5, 2.1}, 1.1, 0.7);
  double camera_distance = 6;
  double sphere_share = 0.94;  // of the picture's width and height

  // A light centred there that faces the origin, its u side level.
  static RectangleLight facing_origin(const Eigen::Vector3d& center, double half_width,
                                      double half_height);
};

// A point of the sphere. Its tangent frame follows the parallels and meridians about the upright
// axis: x points east (to the right, as the camera sees it), y north, z out.
struct ShadingPoint {
  Eigen::Vector3d position;
  Eigen::Matrix3d to_tangent;  // world directions to the tangent frame
  Eigen::Vector3d omega_v;     // towards the camera, in the tangent frame

  Lobe lobe(double alpha_x, double alpha_y, const LobeModel& model) const;
  // The light as the point sees it: relative to it, in its tangent frame.
  RectangleLight seen(const RectangleLight& light) const;
};

// Where the camera ray through a point of the picture meets the sphere: x to the right and y up,
// both from -1 to 1. Nothing where it misses.
std::optional<ShadingPoint> shading_point(const SphereScene& scene, double x, double y);

}  // namespace ltc
