// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "brdf/albedo.h"

#include <cmath>

#include "brdf/lattice.h"
#include "brdf/lobe_model.h"

namespace ltc {

AlbedoRule::AlbedoRule(std::size_t points) {
  const std::size_t count = (points + block_size - 1) / block_size * block_size;
  for (std::vector<float>* column :
       {&cos_azimuth, &sin_azimuth, &height, &one_minus_height, &weight})
    column->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [azimuth, t] = lattice_point(i, count);
    cos_azimuth[i] = static_cast<float>(std::cos(azimuth));
    sin_azimuth[i] = static_cast<float>(std::sin(azimuth));
    height[i] = static_cast<float>(t * t * (3 - 2 * t));
    one_minus_height[i] = static_cast<float>((1 - t) * (1 - t) * (1 + 2 * t));
    weight[i] = static_cast<float>(6 * t * (1 - t) / static_cast<double>(count));
  }
}

Albedo integrate_albedo(const Lobe& lobe, const AlbedoRule& rule) {
  return lobe.model->albedo(lobe, rule);
}

}  // namespace ltc
