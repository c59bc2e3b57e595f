// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/require_model.h"

#include <fmt/format.h>

#include <array>

#include "brdf/lobe_model.h"
#include "core/error.h"

namespace ltc {

// What is served is a box, so that its corners tell of all its lobes.
void require_lobes(const Grid& grid) {
  for (unsigned corner = 0; corner < 16; ++corner) {
    std::array<std::size_t, Grid::axis_count> at{};
    for (std::size_t axis = 0; axis < at.size(); ++axis)
      at[axis] = corner >> axis & 1 ? grid.shape()[axis] - 1 : 0;
    grid.model->require(grid.lobe({at[0], at[1], at[2], at[3]}));
  }
}

void require_model(const Config& config) {
  try {
    require_lobes(config.grid);
  } catch (const InputError& error) {
    throw InputError(fmt::format("table.brdf: {}", error.what()));
  }
  if (config.grid.model->about_mirror())
    return;
  const auto refuse = [&](std::string_view what, std::string_view instead) {
    throw InputError(
        fmt::format("table.brdf = \"{}\" with {}; expected {}: its lobes are not about the mirror "
                    "direction",
                    config.grid.model->name(), what, instead));
  };
  if (config.field.size > 0)
    refuse(fmt::format("field.size = {}", config.field.size), "0, a table");
  if (config.fit.lobe == LobeKind::folded)
    refuse("fit.lobe = \"folded\"", "\"single\"");
  if (is_in_mirror_frame(config.storage))
    refuse(fmt::format("table.storage = \"{}\"", name_of(config.storage)),
           "\"matrix\", \"inverse\" or \"roughness-scaled\"");
}

}  // namespace ltc
