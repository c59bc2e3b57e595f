// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/options.h"

#include <fmt/format.h>
#include <omp.h>

#include <charconv>

#include "cli/output.h"
#include "export/config_file.h"

namespace ltc::cli {
namespace {

constexpr int most_threads = 1024;

// A message if the text is no number of threads.
std::string check_threads(const std::string& text) {
  int threads = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, threads);
  if (error == std::errc() && stop == end && threads >= 1 && threads <= most_threads)
    return "";
  return fmt::format("{} is not allowed; expected a whole number in [1, {}]", text, most_threads);
}

}  // namespace

std::optional<std::filesystem::path> ConfigArguments::path() const {
  return file.empty() ? std::nullopt : std::optional<std::filesystem::path>(file);
}

Config ConfigArguments::load() const {
  return load_config_or_table(path(), overrides);
}

std::string ConfigArguments::as_text() const {
  std::string text;
  if (!file.empty())
    text += " --config " + shell_quoted(file);
  for (const std::string& override : overrides)
    text += " --set " + shell_quoted(override);
  return text;
}

void add_config_options(CLI::App& app, ConfigArguments& arguments, const ConfigHelp& help) {
  const auto not_empty = [](const std::string& text) {
    return std::string(text.empty() ? "is empty; expected a TOML file or a table's .h5" : "");
  };
  app.add_option("-c,--config", arguments.file, help.file)
      ->check(not_empty)
      ->option_text("FILE")
      ->group(help.group);
  app.add_option(
         "-s,--set", arguments.overrides,
         fmt::format("change one key of the config, for example {}; can be repeated", help.example))
      ->allow_extra_args(false)
      ->option_text("KEY=VALUE")
      ->group(help.group);
}

void add_output_option(CLI::App& app, std::string& folder) {
  app.add_option("-o,--output", folder,
                 fmt::format("folder for the files, created if need be [{}]", folder))
      ->check([](const std::string& text) {
        return std::string(text.empty() ? "is empty; expected a folder" : "");
      })
      ->option_text("DIR")
      ->group("Where to write");
}

CLI::Option* add_png_option(CLI::App& app, const std::string& name, std::string& file,
                            const std::string& what) {
  // A folder is refused where the picture is written, with the reason.
  const auto is_png = [](const std::string& text) {
    const bool good =
        std::filesystem::is_directory(text) || std::filesystem::path(text).extension() == ".png";
    return good ? std::string() : fmt::format("{} does not end in .png", text);
  };
  return app.add_option(name, file, what + ", as PNG [none]")->check(is_png)->option_text("FILE");
}

void add_threads_option(CLI::App& app, int& threads) {
  app.add_option("-t,--threads", threads,
                 "threads; the result has the same bits with any number [one a processor]")
      ->check(check_threads)
      ->option_text("N")
      ->group("How to run");
}

int default_threads() {
  return omp_get_num_procs();
}

}  // namespace ltc::cli
