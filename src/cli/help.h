// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What --help prints, and the tables of options that man page and completion are made of too.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

namespace ltc::cli {

// A thing that the help names and what it says of it.
struct HelpEntry {
  std::string left, text;
};
struct HelpGroup {
  std::string title;
  std::vector<HelpEntry> entries;
};

// "ltcfit diff [OPTION]... A B".
std::string usage_text(const CLI::App& app);

// The arguments without names, then the options in their groups.
std::vector<HelpGroup> option_groups(const CLI::App& app);
// The commands of the program in theirs.
std::vector<HelpGroup> command_groups();

// The help of a command, and of the program; no line is longer than `columns`, where words allow.
std::string command_help(const CLI::App& app, std::size_t columns);
std::string program_help(const CLI::App& app, std::size_t columns);

// What the exit codes mean.
inline constexpr const char* exit_codes =
    "Exit codes: 0 done, 1 a check failed, 2 bad input, 3 a file could not be read or written, 130 "
    "interrupted.";

}  // namespace ltc::cli
