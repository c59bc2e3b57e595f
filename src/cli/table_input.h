// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables that a command reads: what the first two axes of an array without axes hold.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "export/table_file.h"

namespace ltc::cli {

// --layout, for files that do not say what they hold; nothing where it is left out.
void add_layout_option(CLI::App& app, std::optional<ReadAs>& as);

// read_table; on standard error, in a line, what a file was taken for that does not say it, and
// why.
Table read_input(const std::string& file, const std::optional<ReadAs>& as);

}  // namespace ltc::cli
