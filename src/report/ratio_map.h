// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The picture of a comparison: every entry of the table in the colour of its ratio.
#pragma once

#include <string>
#include <vector>

#include "judge/compare.h"
#include "picture/heat_map.h"
#include "table/grid.h"

namespace ltc {

// The ratio of the losses of A and B to GGX over the whole table: tiles by alpha (rows) and lambda
// (columns), within a tile theta downwards and phi to the right, as in the EXR atlas. The scale is
// logarithmic about 1, and wide enough for 99 % of the entries with alpha > alpha_min; the planes
// alpha <= alpha_min, where ratios may be far larger, do not stretch it. The `marked` largest
// ratios above 1 are ringed.
picture::TiledMap ratio_map(const Grid& grid, const std::vector<EntryComparison>& entries,
                            const std::string& name_a, const std::string& name_b,
                            std::size_t marked = 3);

}  // namespace ltc
