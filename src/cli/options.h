// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Options that several subcommands share.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"

namespace ltc::cli {

// --config and --set.
struct ConfigArguments {
  std::string file;  // TOML, or a table's .h5, whose config it is; empty: defaults
  std::vector<std::string> overrides;

  std::optional<std::filesystem::path> path() const;
  Config load() const;
  // " --config F --set key=value", as a shell reads it.
  std::string as_text() const;
};

// How the help describes them.
struct ConfigHelp {
  const char* file = "TOML file that says what differs from the defaults, or a table's .h5 [none]";
  const char* example = "fit.seed=2";
  const char* group = "What to fit";
};
void add_config_options(CLI::App& app, ConfigArguments& arguments, const ConfigHelp& help = {});
void add_output_option(CLI::App& app, std::string& folder);
// A file that is written as PNG; other endings are refused, for viewers go by them.
CLI::Option* add_png_option(CLI::App& app, const std::string& name, std::string& file,
                            const std::string& what);
void add_threads_option(CLI::App& app, int& threads);

// As many threads as this process may use processors.
int default_threads();

}  // namespace ltc::cli
