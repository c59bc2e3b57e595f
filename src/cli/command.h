// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A subcommand of the program, and the table of all of them.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <span>

#include "cli/files.h"

namespace ltc::cli {

// What a subcommand does once its arguments are read; `files` knows the files that its options
// name. The library's exceptions tell what went wrong.
using Action = std::function<void(Files& files)>;

struct Command {
  const char* name;
  const char* group;    // the heading it stands under in --help
  const char* summary;  // one line
  // Declares the options on `app` and returns the action that uses them.
  Action (*declare)(CLI::App& app);
  bool is_shared = false;  // by the ranks of a launcher; otherwise one of them does it
};

// In the order of --help.
std::span<const Command> commands();

// A command with its options declared, --help among them.
struct DeclaredCommand {
  std::unique_ptr<CLI::App> app;
  Action action;
};
DeclaredCommand declared(const Command& command);

// The options of the whole program alone, --help and --version.
std::unique_ptr<CLI::App> program_options();

}  // namespace ltc::cli
