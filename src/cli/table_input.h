// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables that a command reads and writes: what files hold that do not say it, and what was written.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "cli/files.h"
#include "export/table_file.h"

namespace ltc::cli {

// --layout, for files that do not say what they hold; nothing where it is left out.
void add_layout_option(CLI::App& app, std::optional<ReadAs>& as);

// read_table; on standard error, in a line, what a file was taken for that does not say it, and
// why.
// Whether tables of folded lobes (ltc/folded.h) are for this command.
enum class FoldedLobes { refused, taken };
Table read_input(const std::string& file, const std::optional<ReadAs>& as,
                 FoldedLobes folded = FoldedLobes::taken);

// Writes a table to the files of `output` in the layout that the options ask for, and prints their
// names. None may be one that the command reads or writes already (Files).
void write_output(const Table& table, const NamedSet& output, const WriteOptions& options,
                  Files& files);

}  // namespace ltc::cli
