// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the picture of a lobe shows: where it looks, and the mean densities of its pixels.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "brdf/ggx.h"
#include "ltc/folded.h"
#include "picture/canvas.h"

namespace ltc {

// Where a picture looks: a square in Lambert's azimuthal equal-area projection about an axis, in
// which a direction at the angle a from the axis is 2 sin(a/2) from the origin (for small angles,
// the angle itself), and every pixel covers the same solid angle.
struct LobeWindow {
  Eigen::Matrix3d rotation;           // from the projection's frame, axis e_z, to the tangent frame
  double center_x = 0, center_y = 0;  // of the square
  double half_width = 0;              // half its side
  bool hemisphere = false;            // about the normal, and all that is above the horizon

  // The point of a unit direction.
  Eigen::Vector2d project(const Eigen::Vector3d& omega) const;
  // Whether a direction is in the square and, over the hemisphere, above the horizon.
  bool contains(const Eigen::Vector3d& omega) const;
};

// The hemisphere seen from above, z the pole in the middle, x to the right and y up.
LobeWindow hemisphere_window();

// The hemisphere for broad lobes. For others a square about the mirror direction that holds at
// least nine tenths of the GGX lobe and, where they are finite, of those shown beside it.
LobeWindow choose_window(const Lobe& lobe, std::span<const LtcLobe> beside);
LobeWindow choose_window(const Lobe& lobe, const Eigen::Matrix3d& matrix);

// Mean densities per steradian of the pixels of a window, `side` by `side`, row by row from the
// top. Each lobe integrates to one over the hemisphere (GGX) or sphere (LTC). NaN for pixels whose
// centre is below the horizon in a picture of the hemisphere; all NaN for an LTC whose matrix is
// singular or not finite. A ridge thinner than a pixel has its mass in the pixels that it crosses.
picture::Field lobe_density(const Lobe& lobe, const LobeWindow& window, std::size_t side);
picture::Field ltc_density(const LtcLobe& shown, const Lobe& lobe, const LobeWindow& window,
                           std::size_t side);

}  // namespace ltc
