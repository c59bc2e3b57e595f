// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables from and to files of any format (export/format.h); the file's name says which. Of a set of
// several files, any one stands for all.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "export/format.h"

namespace ltc {

// `as` is for files that do not say what they hold; those that do go by it. Throws InputError for a
// name that no format ends in, and as Format::read.
Table read_table(const std::filesystem::path& path, const ReadAs& as = {});

// Whole or not at all: older files stand until the new ones are whole. Throws InputError for a name
// that no format ends in, for a table that is not consistent (export/consistency.h) or that the
// format cannot hold, IoError where the system refuses.
void write_table(const Table& table, const std::filesystem::path& path,
                 const WriteOptions& options = {});

// The same as files among others, which all take their places with set.commit().
void add_table(platform::FileSet& set, const Table& table, const Format& format,
               const std::filesystem::path& prefix, const WriteOptions& options);

// All files that read_table reads for this one; of a name that no format ends in, itself.
TableFiles files_of_table(const std::filesystem::path& path);

// What the file holds that the table was read from. Throws as read_table for a name that no format
// ends in.
TableContents contents_of(const std::filesystem::path& path, const Table& table);

// Whether it is of a format that keeps_fits.
bool is_whole_table(const std::filesystem::path& path);

// The TOML of a config's file, or of the config that a whole table's file holds. Throws as
// read_config and read_table.
std::string config_text(const std::filesystem::path& file);

}  // namespace ltc
