// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What of a material lies beyond a table's axes: look-ups clamp it, and so show another material.
#pragma once

#include <string>
#include <vector>

#include "render/shading.h"
#include "table/grid.h"

namespace ltc {

// The value of one axis that is farthest beyond it, and the end of the axis that stands for it.
struct ClampedAxis {
  std::string axis;  // "alpha", "lambda"; "theta", "phi" in degrees
  double asked, taken;
};

// Over a whole sphere, on which every view direction occurs. At equal roughnesses phi is no matter.
std::vector<ClampedAxis> clamped_axes(const Grid& grid, const SphereMaterial& material);

// "alpha 0.8 to 0.6, theta 90 to 60"; empty where nothing is clamped.
std::string clamping_text(const std::vector<ClampedAxis>& clamped);

}  // namespace ltc
