// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The lights of rendered pictures: flat ones, spheres and tubes, of radiance 1 or with an image.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/enum_names.h"

namespace ltc {

class LightTexture;  // render/light_texture.h

enum class LightShape {
  rectangle,
  star,    // five points, the first along half_v
  disk,    // an ellipse where the half sides differ
  sphere,  // of radius |half_u|
  line,    // a tube along half_u, of radius |half_v|, without its ends
};
constexpr EnumNames<LightShape, 5> enum_names(LightShape) {
  return {"light",
          {{{LightShape::rectangle, "rectangle"},
            {LightShape::star, "star"},
            {LightShape::disk, "disk"},
            {LightShape::sphere, "sphere"},
            {LightShape::line, "line"}}}};
}

// Emits radiance 1, flat ones from the side that half_u x half_v points to or from both. Lengths
// are those of the scene; the half sides are perpendicular.
struct Light {
  Eigen::Vector3d center, half_u, half_v;
  LightShape shape = LightShape::rectangle;
  bool two_sided = false;
  std::shared_ptr<const LightTexture> texture{};  // of a rectangle: its luminance times radiance 1

  Eigen::Vector3d normal() const;
  // The polygon in units of the half sides, and in space; of a rectangle and a star, else empty.
  // Integrals over it (ltc/polygon.h) are positive where the origin is on the side of the normal.
  std::span<const Eigen::Vector2d> outline() const;
  std::vector<Eigen::Vector3d> corners() const;
  // Whether light goes from it towards the origin, if nothing is between.
  bool emits_to_origin() const;
  // Whether the box around it reaches above z = 0.
  bool reaches_above_horizon() const;
  // The flat light that covers the same directions seen from the origin: of a sphere the disk of
  // its outline (ltc/disk.h), of a line the strip of its; nothing where the view is along the line.
  // Throws InputError where the origin lies within the light.
  std::optional<Light> flat() const;
};

// A light centred there that faces the origin, its u side level.
Light light_facing_origin(const Eigen::Vector3d& center, double half_width, double half_height);

// The light of a shape, half sides in the scene's units times `size`: rectangle 1.1 x 0.7; star 1.1
// (and 0.45 between its points); disk 0.8; sphere 0.6; line 1.1 with radius 0.03.
Light standard_light(LightShape shape, const Eigen::Vector3d& center, double size);

}  // namespace ltc
