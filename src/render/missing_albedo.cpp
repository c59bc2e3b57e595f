// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/missing_albedo.h"

#include <cmath>

#include "brdf/albedo.h"

namespace ltc {

void fill_missing_albedo(Table& table) {
  const AlbedoRule rule;
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
    if (!has_values(table.status[flat]) ||
        (std::isfinite(table.amplitude[flat]) && std::isfinite(table.fresnel[flat])))
      continue;
    const Albedo albedo = integrate_albedo(table.grid.lobe(flat), rule);
    table.amplitude[flat] = static_cast<float>(albedo.amplitude);
    table.fresnel[flat] = static_cast<float>(albedo.fresnel);
  }
}

}  // namespace ltc
