// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the materials of a scene ask a table for.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "table/queries.h"

namespace ltc {

// One range a material: the least that holds all its lobes, folded so that alpha_x >= alpha_y
// (equation 14 of Aakash et al. 2022). It holds others too where larger and smaller roughness
// depend on one another.
std::vector<QueryRange> query_ranges(const Scene& scene);

}  // namespace ltc
