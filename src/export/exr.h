// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables as three OpenEXR images, each a 3-D texture laid out as an atlas: pixel x = phi + Nphi
// lambda, y = theta + Ntheta alpha. docs/files.md says which channel holds what.
#pragma once

#include <filesystem>

#include "core/platform.h"
#include "table/table.h"

namespace ltc {

// <prefix>.<index>.exr, index 0 to 2.
std::filesystem::path exr_path(const std::filesystem::path& prefix, int index);

// Writes the three files, in 16 bits with `half` and in 32 otherwise; they take their places once
// all are written. The same table gives the same bytes. Skipped and failed
// entries take the values of nearest_fitted (export/nearest.h). Throws InputError for a table that
// is not consistent or has no entry with values, for a fitted entry whose amplitude or Fresnel term
// is not finite, and for a value beyond the 16-bit range (65504); IoError where the system refuses.
void write_exr(const Table& table, const std::filesystem::path& prefix, bool half);

// The same as three of several files, which all take their places with files.commit().
void add_exr(platform::FileSet& files, const Table& table, const std::filesystem::path& prefix,
             bool half);

// What the three files hold: every entry counts as fitted, its loss is NaN, its steps 0, precision
// `half` where a channel is; brdf, seed, config, generator and created are empty. Throws IoError
// for a file that cannot be opened; InputError, naming file and fault, for one that is not of the
// layout, is damaged, or disagrees with the others.
Table read_exr(const std::filesystem::path& prefix);

}  // namespace ltc
