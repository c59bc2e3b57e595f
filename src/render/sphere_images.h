// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Renders the sphere of sphere_scene.h in one material, as figure 14 of Aakash et al. 2022: GGX by
// sampling, and the LTC of one or more tables.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "core/run_context.h"
#include "picture/canvas.h"
#include "render/shading.h"

namespace ltc {

struct SphereSettings {
  SphereScene scene;
  std::size_t size = 320;      // pixels, width and height
  std::size_t samples = 2048;  // of the reference, a pixel; rounded up to a multiple of 16
  HorizonMode horizon = HorizonMode::clipped;  // of the tables' lobes
};

// Square images, one value a pixel: radiance over that of the light, 0 where the sphere is not. A
// pixel is the mean of 2 x 2 points, the same in every image.
struct SphereImages {
  picture::Field coverage;        // share of the pixel's points that lie on the sphere
  picture::Field reference;       // GGX
  picture::Field standard_error;  // of the reference, a rough one a pixel: two estimates differ so
  std::vector<picture::Field> ltc;  // one a table; NaN where it has no value
};

// The same bits with any number of threads. Throws InputError for a material out of range
// (roughnesses in [1e-4, 1], F0 in [0, 1]), a size of 0, or no samples.
SphereImages render_sphere(std::span<const Table* const> tables, const SphereMaterial& material,
                           const SphereSettings& settings, std::string_view stage,
                           const RunContext& run);

// LTC minus GGX, pixel by pixel.
picture::Field difference(const SphereImages& images, std::size_t table);

// One table's image against the reference, over the pixels of the sphere where it has a value.
struct SphereError {
  std::size_t pixels = 0;   // these
  std::size_t without = 0;  // pixels of the sphere without a value
  double reference_mean = 0;
  double mean_absolute = 0;   // in units of the light's radiance
  double relative_rmse = 0;   // root mean square error over reference_mean
  double standard_error = 0;  // of the reference's pixels, root mean square
  // The same over reference_mean: what a table without any error would have as relative_rmse.
  double relative_noise = 0;
};
SphereError sphere_error(const SphereImages& images, std::size_t table);

}  // namespace ltc
