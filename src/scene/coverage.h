// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Which entries of a table the look-ups of a scene touch.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "table/grid.h"

namespace ltc {

// One flag a node of `grid`, in its order: whether look_up (table/lookup.h) of any material of the
// scene, at any azimuth, gives the node a weight other than 0. Neither more nor less, up to the
// rounding of the roughnesses: a material that stands exactly on a plane of nodes does not need
// their neighbours, an isotropic one needs lambda = 1 alone.
// Roughnesses are looked up as they are; those below alpha_min are not raised to it first.
std::vector<bool> needed_entries(const Scene& scene, const Grid& grid);

}  // namespace ltc
