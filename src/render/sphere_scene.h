// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What is rendered: a sphere, or a flat or bent sheet, under a light, seen by a pinhole camera.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "brdf/ggx.h"
#include "core/enum_names.h"
#include "render/light.h"

namespace ltc {

enum class ObjectShape {
  sphere,  // radius 1 about the origin
  plane,   // (x, 0, z), |x| and |z| <= 1.6, seen from above
  sheet,   // (x, 1.5 cos t - 1, 1.5 sin t), |x| <= 1.6, |t| <= 60 degrees, seen from outside
};
constexpr EnumNames<ObjectShape, 3> enum_names(ObjectShape) {
  return {"shape",
          {{{ObjectShape::sphere, "sphere"},
            {ObjectShape::plane, "plane"},
            {ObjectShape::sheet, "sheet"}}}};
}

// Where the light of a scene is unless it is said: up, to the right and before the sphere; above
// and behind the middle of a plane and a sheet, whose reflections it shows.
Eigen::Vector3d usual_light_position(ObjectShape shape);

// World: y is up. The camera looks at the origin, for the sphere along -z, for others 30 degrees
// downwards, from camera_distance.
struct SphereScene {
  Light light = standard_light(LightShape::rectangle, usual_light_position(ObjectShape::sphere), 1);
  ObjectShape shape = ObjectShape::sphere;
  double camera_distance = 6;
  double sphere_share = 0.94;  // what a sphere takes of the picture's width and height
};

// A point of the object. Tangent frame: x east (to the right, as the camera sees it), z out. On the
// sphere x follows the parallels about the upright axis, y the meridians; on plane and sheet x is
// the world's x, and y leads away from the camera.
struct ShadingPoint {
  Eigen::Vector3d position;
  Eigen::Matrix3d to_tangent;  // world directions to the tangent frame
  Eigen::Vector3d omega_v;     // towards the camera, in the tangent frame

  Lobe lobe(double alpha_x, double alpha_y, const LobeModel& model) const;
  // The light as the point sees it: relative to it, in its tangent frame.
  Light seen(const Light& light) const;
};

// Where the camera ray through a point of the picture meets the object: x to the right and y up,
// both from -1 to 1. Nothing where it misses.
std::optional<ShadingPoint> shading_point(const SphereScene& scene, double x, double y);

}  // namespace ltc
