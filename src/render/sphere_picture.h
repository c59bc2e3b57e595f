// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Rendered objects as one picture: a row a material; GGX, then LTC and difference for each table.
#pragma once

#include <string>
#include <vector>

#include "picture/canvas.h"
#include "render/clamping.h"
#include "render/sphere_images.h"

namespace ltc {

struct SphereRow {
  SphereMaterial material;
  SphereImages images;
  std::vector<std::vector<ClampedAxis>> clamped{};  // one a table; or none, where nothing is
};

struct SpherePicture {
  std::string title;
  std::vector<std::string> caption;  // lines below
  std::vector<std::string> tables;   // what their columns are called
  std::vector<SphereRow> rows;       // all images of one size
  ObjectShape shape = ObjectShape::sphere;
  std::string reference = "GGX";  // what is sampled
};

// Radiance is shown in sRGB; a row's images share an exposure, which brings the brightest of GGX
// near white, and its differences a scale, which takes in all but the largest 0.2 %. Throws
// InputError if there is no row or no table.
picture::Canvas draw(const SpherePicture& content);

}  // namespace ltc
