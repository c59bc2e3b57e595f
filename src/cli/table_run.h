// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A run that makes a table's files, as generate and merge have it: options, progress, summary.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "cli/files.h"
#include "cli/launch.h"
#include "pipeline/run.h"

namespace ltc::cli {

struct TableRunArguments {
  std::string scene;                 // empty: the whole table
  std::string extend;                // empty: a new table
  std::string output = "out", json;  // json empty: none
  int threads = default_threads();
  bool resume = false;
  double checkpoint_seconds = RunRequest().checkpoint_seconds;
};

void add_table_run_options(CLI::App& app, TableRunArguments& arguments);
// Headings of theirs, for what a command has in addition.
inline constexpr const char *what_to_fit = "What to fit", *how_to_run = "How to run";

// Calls `work` with what the arguments ask for and how to do it, while interrupts ask it to stop.
// The config is that of load(), which of several ranks the first one calls; that one hears, says
// and writes everything.
void run_watched(const TableRunArguments& arguments, const std::function<Config()>& load,
                 Files& files,
                 const std::function<void(RunRequest& request, const RunContext& context)>& work);

// Makes the table and tells what became of it. `fit_command` looks into the fit of an entry;
// empty: none does.
void make_and_tell(const TableRunArguments& arguments, const RunRequest& request,
                   const RunContext& context, Files& files, const std::string& fit_command);

}  // namespace ltc::cli
