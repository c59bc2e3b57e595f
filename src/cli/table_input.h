// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables that a command reads: what the first two axes of an array without axes hold.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "table/table.h"

namespace ltc::cli {

// --layout, for .npy; nothing where it is left out.
void add_layout_option(CLI::App& app, std::optional<Layout>& layout);

// read_table; on standard error, in a line, where an array was taken for one of alpha_x and alpha_y
// without being told to.
Table read_input(const std::string& file, std::optional<Layout> layout);

}  // namespace ltc::cli
