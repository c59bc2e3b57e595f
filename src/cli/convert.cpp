// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit convert: a table in another format or layout.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/command.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/table_input.h"
#include "core/error.h"
#include "export/table_file.h"

namespace ltc::cli {
namespace {

struct Arguments {
  std::string input, output;
  std::optional<ReadAs> layout;
  WriteOptions options;
  bool functions = false;
};

std::string written_endings() {
  return endings_text([](const Format& format) { return static_cast<bool>(format.add); });
}

void convert(const Arguments& arguments, Files& files) {
  const Table table = read_input(arguments.input, arguments.layout);
  const NamedSet output = set_to_write(arguments.output, table.field || arguments.functions);
  if (!output.format)
    throw InputError(fmt::format("-o {}: no suffix of a table; expected {}",
                                 one_line(arguments.output), written_endings()));
  const TextureLayout layout = resolved(arguments.options.layout, table.grid, table.storage);
  const TableFiles written = output.format->files(output.prefix, table.grid, table.storage, layout);
  const std::string plain = output.prefix.string() + output.format->sets.back().front();
  if (arguments.output != plain &&
      std::ranges::find(written, std::filesystem::path(arguments.output)) == written.end())
    throw InputError(fmt::format("-o {}: no file of layout {}; expected {} or {}",
                                 one_line(arguments.output), name_of(layout), one_line(plain),
                                 one_line(written.front().string())));
  write_output(table, output, arguments.options, files);
}

}  // namespace

Action declare_convert(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_table_argument(app, "TABLE", arguments->input, "table to read");
  allow(app.add_option("-o,--output", arguments->output,
                       "file to write, " + written_endings() +
                           "; where the textures are several files, _1 and _2 or .0, .1 and .2 "
                           "stand before the ending"),
        not_empty("a file"))
      ->required()
      ->option_text("FILE")
      ->group("What to write");
  add_names_option(app, "--as", arguments->options.layout,
                   "how the values lie in textures [automatic: ltc for isotropic tables of storage "
                   "inverse, volumes for others]")
      ->option_text("LAYOUT")
      ->group("What to write");
  app.add_flag("--half", arguments->options.half, "16-bit values, where the format has them")
      ->group("What to write");
  app.add_flag_function(
         "--no-zstd", [arguments](std::int64_t) { arguments->options.zstd = false; },
         "leave KTX2 uncompressed")
      ->group("What to write");
  add_names_option(app, "--script", arguments->options.javascript_style,
                   "what a .js is: a module of arrays, or the one that three.js imports [arrays]")
      ->option_text("STYLE")
      ->group("What to write");
  app.add_flag(
         "--functions", arguments->functions,
         "a .h that looks up, integrates and samples, not the arrays alone; of fields, always")
      ->group("What to write");
  add_layout_option(app, arguments->layout);
  return [arguments](Files& files) { convert(*arguments, files); };
}

}  // namespace ltc::cli
