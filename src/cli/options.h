// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How options are declared: what their values may be, which files they name, and those that several
// subcommands share.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/config.h"
#include "core/enum_names.h"
#include "core/range.h"

namespace ltc::cli {

// ---- Values ----

// What a value may be: `take` tells, and may write it in the form that its type is read from.
struct Allowed {
  std::string expected;  // completes "expected …"
  std::function<bool(std::string&)> take;
};
Allowed whole_number(double least, double most);  // also as 1e6
Allowed number(const Range& range);
Allowed any_number();  // where its range is checked later
Allowed not_empty(const std::string& expected);
// The seeds that configs take too.
Allowed seed_number();

// Refuses other values with one line, "--samples 5: expected a whole number in [64, 4096]".
CLI::Option* allow(CLI::Option* option, Allowed allowed);

// Likewise all but these names.
CLI::Option* allow_names(CLI::Option* option, const std::vector<std::string>& names);

// One that takes the names of an enum.
template <Named Enum>
CLI::Option* add_names_option(CLI::App& app, const std::string& name, Enum& value,
                              const std::string& what) {
  return allow_names(
      app.add_option_function<std::string>(
          name, [&value](const std::string& text) { value = value_named<Enum>(text); }, what),
      all_names<Enum>());
}

// ---- Files ----

// What the value of an option is. Kept as the option's type name, for Files and for completion;
// of names, "{a,b}".
namespace value_kind {
inline constexpr std::string_view input = "input", image = "image", output = "output",
                                  json = "json", folder = "folder";
}

// A file that the command reads.
CLI::Option* add_input_option(CLI::App& app, const std::string& name, std::string& file,
                              const std::string& what);
// The same, as an argument without a name that has to be given: a table of any format.
void add_table_argument(CLI::App& app, const std::string& name, std::string& file,
                        const std::string& what);
// An image, as an argument without a name that has to be given.
void add_image_argument(CLI::App& app, const std::string& name, std::string& file,
                        const std::string& what);
// A file that the command writes, in a folder that is there.
CLI::Option* add_output_option(CLI::App& app, const std::string& name, std::string& file,
                               const std::string& what);
// One that is written as PNG; other endings are refused, for viewers go by them.
CLI::Option* add_png_option(CLI::App& app, const std::string& name, std::string& file,
                            const std::string& what);
// A folder that the command creates if need be, with Files::make_folder.
CLI::Option* add_folder_option(CLI::App& app, const std::string& name, std::string& folder,
                               const std::string& what);
// --json, for print_results (cli/output.h).
CLI::Option* add_json_option(CLI::App& app, std::string& file);

// ---- Shared by several ----

// --config and --set.
struct ConfigArguments {
  std::string file;  // TOML, or a table's .h5, whose config it is; empty: defaults
  std::vector<std::string> overrides;

  std::optional<std::filesystem::path> path() const;
  static constexpr const char* override_option = "--set";
  Config load() const;  // reads the file once: it may be a pipe
  // " --config F --set key=value", as a shell reads it.
  std::string as_text() const;

  mutable std::optional<std::string> toml = std::nullopt;  // what the file says, once it is read
};

// How the help describes them.
struct ConfigHelp {
  const char* file = nullptr;  // null: a config of generate, or a table with one
  const char* example = "fit.gauss_newton.samples=4096";
  const char* group = "What to fit";
};
void add_config_options(CLI::App& app, ConfigArguments& arguments, const ConfigHelp& help = {});
void add_threads_option(CLI::App& app, int& threads);

}  // namespace ltc::cli
