// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How entries of a table are written.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "table/grid.h"

namespace ltc {

// "3,0,7,4": the node's indices.
std::string entry_text(const Grid& grid, std::size_t flat);

// "8x8x8x8": how many nodes the axes have.
std::string shape_text(const Grid& grid, std::string_view between = "x");

// "alpha_x 0.429, alpha_y 0.143, …" with layout alphax_alphay.
// "alpha 0.429, lambda 0.000, theta 89.991, phi 51.4", angles in degrees.
std::string lobe_text(const Grid& grid, std::size_t flat);

}  // namespace ltc
