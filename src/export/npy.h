// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables as one NumPy array of matrices, the layout of the published table.
#pragma once

#include <filesystem>
#include <optional>

#include "core/platform.h"
#include "table/table.h"

namespace ltc {

// Whether an array without axes can stand for tables of this grid: readers take its axes and
// alpha_min to be Grid::paper's, with node counts of the array's own.
bool npy_can_hold(const Grid& grid);

// Writes M of every node, whatever the storage, as f32 (Nalpha, Nlambda, Ntheta, Nphi, 3, 3) in C
// order; NaN where an entry is skipped or failed. Whole or not at all; the same table gives the
// same bytes. Throws InputError for a grid that npy_can_hold refuses or a table that is not
// consistent, IoError where the system refuses.
void write_npy(const Table& table, const std::filesystem::path& path);

// The same as one of several files, which all take their places with files.commit().
void add_npy(platform::FileSet& files, const Table& table, const std::filesystem::path& path);

// The table of such an array: the paper's axes, storage `matrix`; the first two are those of
// `layout` or, where it is not given, of layout_of. Amplitude, Fresnel term and loss
// are NaN, steps 0; an entry of nine NaNs counts as skipped, every other as fitted. Throws IoError
// for a file that cannot be opened; InputError, naming file and fault, for one that is no such
// array or is cut short.
Table read_npy(const std::filesystem::path& path, std::optional<Layout> layout = std::nullopt);

// What the first two axes of such an array hold, by the symmetry that only alpha_x and alpha_y
// give it: exchanging them with x and y and phi with 90 degrees - phi gives the same matrix. Of the
// published tables, one differs from its image by 0.2 % of a matrix in the median, the other by
// half of it. Tables that can have no such symmetry (node counts that differ, one node along phi or
// alpha) are alpha_lambda.
Layout layout_of(const Table& table);

}  // namespace ltc
