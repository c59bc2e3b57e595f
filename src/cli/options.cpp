// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cli/output.h"
#include "core/error.h"
#include "core/parallel.h"
#include "export/table_file.h"

namespace ltc::cli {
namespace {

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

CLI::Option* of_kind(CLI::Option* option, std::string_view kind, const char* shown_as) {
  return option->type_name(std::string(kind))->option_text(shown_as);
}

}  // namespace

Allowed whole_number(double least, double most) {
  const Range range{least, most};
  return {"a whole number in " + range.text(), [=](std::string& text) {
            const std::optional<double> value = number_of(text);
            if (!value || !range.contains(*value) || *value != std::trunc(*value))
              return false;
            if (text.find_first_not_of("0123456789") != std::string::npos)
              text = fmt::format("{:.0f}", *value);
            return true;
          }};
}

Allowed number(const Range& range) {
  return {"a number in " + range.text(), [=](std::string& text) {
            const std::optional<double> value = number_of(text);
            return value && range.contains(*value);
          }};
}

Allowed any_number() {
  return {"a number", [](std::string& text) { return number_of(text).has_value(); }};
}

Allowed not_empty(const std::string& expected) {
  return {expected, [](std::string& text) { return !text.empty(); }};
}

Allowed seed_number() {
  return whole_number(0, 9007199254740992);  // 2^53: exact wherever JSON or a double carries it
}

CLI::Option* allow(CLI::Option* option, Allowed allowed) {
  const auto check = [allowed = std::move(allowed), option](std::string& text) {
    if (!allowed.take(text))
      throw InputError(fmt::format("{} {}: expected {}", option->get_name(), shell_quoted(text),
                                   allowed.expected));
    return std::string();
  };
  return option->transform(CLI::Validator(check, ""));
}

CLI::Option* allow_names(CLI::Option* option, const std::vector<std::string>& names) {
  const auto is_one = [names](std::string& text) {
    return std::find(names.begin(), names.end(), text) != names.end();
  };
  const std::vector<std::string> first(names.begin(), names.end() - 1);
  option->type_name(fmt::format("{{{}}}", fmt::join(names, ",")));
  return allow(option, {fmt::format("{} or {}", fmt::join(first, ", "), names.back()), is_one});
}

CLI::Option* add_input_option(CLI::App& app, const std::string& name, std::string& file,
                              const std::string& what) {
  CLI::Option* const option = of_kind(app.add_option(name, file, what), value_kind::input, "FILE");
  return allow(option, not_empty("a file"));
}

void add_table_argument(CLI::App& app, const std::string& name, std::string& file,
                        const std::string& what) {
  add_input_option(app, name, file, what + ", " + endings_text(is_read))->required();
}

void add_image_argument(CLI::App& app, const std::string& name, std::string& file,
                        const std::string& what) {
  CLI::Option* const option = of_kind(app.add_option(name, file, what), value_kind::image, "FILE");
  allow(option, not_empty("a file"))->required();
}

CLI::Option* add_output_option(CLI::App& app, const std::string& name, std::string& file,
                               const std::string& what) {
  CLI::Option* const option =
      of_kind(app.add_option(name, file, what + " [none]"), value_kind::output, "FILE");
  return allow(option, {"a file; ./- is one of that name",
                        [](std::string& text) { return !text.empty() && text != "-"; }});
}

CLI::Option* add_png_option(CLI::App& app, const std::string& name, std::string& file,
                            const std::string& what) {
  // A folder is refused by Files, with the reason.
  const auto is_png = [](std::string& text) {
    return std::filesystem::is_directory(text) || std::filesystem::path(text).extension() == ".png";
  };
  CLI::Option* const option =
      of_kind(app.add_option(name, file, what + ", as PNG [none]"), value_kind::output, "FILE");
  return allow(option, {"a file that ends in .png", is_png});
}

CLI::Option* add_folder_option(CLI::App& app, const std::string& name, std::string& folder,
                               const std::string& what) {
  const std::string standard = folder.empty() ? "none" : folder;
  CLI::Option* const option = of_kind(
      app.add_option(name, folder, fmt::format("{}, created if need be [{}]", what, standard)),
      value_kind::folder, "DIR");
  return allow(option, not_empty("a folder"));
}

CLI::Option* add_json_option(CLI::App& app, std::string& file) {
  CLI::Option* const option = of_kind(
      app.add_option("--json", file,
                     "write all results to this file as JSON; -: to standard output, in place of "
                     "the text [none]"),
      value_kind::json, "FILE");
  return allow(option, not_empty("a file, or - for standard output"));
}

std::optional<std::filesystem::path> ConfigArguments::path() const {
  return file.empty() ? std::nullopt : std::optional<std::filesystem::path>(file);
}

Config ConfigArguments::load() const {
  const std::optional<std::filesystem::path> config = path();
  if (!config)
    return load_config(config, overrides, override_option);
  if (!toml)
    toml = config_text(*config);
  return parse_config(*toml, *config, overrides, override_option);
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
  const std::string file =
      help.file ? help.file
                : fmt::format(
                      "TOML file that says what differs from the defaults, or a table's {} "
                      "[none]",
                      endings_text(keeps_fits));
  add_input_option(app, "-c,--config", arguments.file, file)->group(help.group);
  app.add_option(
         "-s,--set", arguments.overrides,
         fmt::format("change one key of the config, for example {}; can be repeated", help.example))
      ->allow_extra_args(false)
      ->option_text("KEY=VALUE")
      ->group(help.group);
}

void add_threads_option(CLI::App& app, int& threads) {
  allow(app.add_option("-t,--threads", threads,
                       "threads; the result has the same bits with any number [one a processor]"),
        whole_number(1, most_threads))
      ->option_text("N")
      ->group("How to run");
}

}  // namespace ltc::cli
