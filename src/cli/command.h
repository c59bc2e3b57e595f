// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A subcommand of the program, and the table of all of them.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>

namespace ltc::cli {

// What a subcommand does once its arguments are read; the library's exceptions tell what went
// wrong.
using Action = std::function<void()>;

struct Command {
  const char* name;
  const char* group;    // the heading it stands under in --help
  const char* summary;  // one line
  // Declares the options on `app` and returns the action that uses them.
  Action (*declare)(CLI::App& app);
};

// In the order of --help.
std::span<const Command> commands();

}  // namespace ltc::cli
