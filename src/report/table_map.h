// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The picture of one figure over a whole table.
#pragma once

#include <vector>

#include "picture/heat_map.h"
#include "table/grid.h"

namespace ltc {

// Tiles by alpha (rows) and lambda (columns), within a tile theta downwards and phi to the right,
// as in the EXR atlas. One value a node, in the grid's order; NaN cells are hatched. No words yet.
picture::TiledMap table_map(const Grid& grid, const std::vector<double>& values,
                            picture::ColorScale colors);

// A ring about an entry, with its indices.
picture::CellMark mark_of(const Grid& grid, std::size_t flat);

}  // namespace ltc
