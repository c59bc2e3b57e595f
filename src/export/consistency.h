// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What holds for every table in a file, whatever the format: checked after reading and before
// writing, so that no file and no look-up ever sees another.
#pragma once

#include <cstddef>
#include <filesystem>

#include "table/table.h"

namespace ltc {

// Larger tables are refused before memory is taken for them.
inline constexpr std::size_t max_nodes_per_axis = 64;

// Throws InputError naming `file` and the axis if the grid has an axis of no or too many nodes,
// with nodes that are not finite, not strictly increasing, out of range (alpha >= 0, lambda in [0,
// 1], theta and phi in [0, pi/2]) or not where the warp puts them, or if alpha_min is not positive.
void require_consistent(const Grid& grid, const std::filesystem::path& file);

// The same, and that every array has the grid's size.
void require_shapes(const Table& table, const std::filesystem::path& file);

// Throws InputError naming `file` for creases (ltc/folded.h) that are none or more than
// most_creases, not of 0 to 100, or not increasing.
inline constexpr std::size_t most_creases = 4;
void require_creases(const Creases& creases, const std::filesystem::path& file);

// The same, and that the matrix of every entry that is neither skipped nor failed is finite,
// and of folded lobes the fold and the creases.
void require_consistent(const Table& table, const std::filesystem::path& file);

// Also with an amplitude and a Fresnel term for every matrix, as files need that hold them: the
// first entry without is refused.
void require_albedo(const Table& table, const std::filesystem::path& file);

}  // namespace ltc
