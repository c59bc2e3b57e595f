// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables as HDF5: all that is known of every entry. docs/files.md says what lies where.
#pragma once

#include <filesystem>

#include "core/platform.h"
#include "table/table.h"

namespace ltc {

// The `format` and `format_version` attributes of the files that this program writes and reads.
inline constexpr const char* table_format = "ltc-table";
inline constexpr int table_format_version = 1;

// Writes the table whole or not at all; the same table gives the same bytes. Throws InputError for
// a table that is not consistent (export/consistency.h), IoError where the system refuses.
void write_hdf5(const Table& table, const std::filesystem::path& path);

// The same as one of several files, which all take their places with files.commit().
void add_hdf5(platform::FileSet& files, const Table& table, const std::filesystem::path& path);

// Throws IoError for a file that cannot be opened; InputError, naming file and fault, for one that
// is no table of this format version, is damaged, or whose parts disagree.
Table read_hdf5(const std::filesystem::path& path);

// The same without the guard of export/hdf5_guard.h: damaged files can crash the process. For
// fuzzers, which learn nothing of what happens in another process.
Table read_hdf5_unguarded(const std::filesystem::path& path);

}  // namespace ltc
