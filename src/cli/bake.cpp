// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit bake: a field's values at the nodes of any grid, as a table.
#include <fmt/format.h>

#include <memory>

#include "cli/command.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/table_input.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/version.h"
#include "export/table_file.h"
#include "table/field_table.h"

namespace ltc::cli {
namespace {

struct Arguments {
  std::string input, output;
  ConfigArguments config;
  WriteOptions options;
};

std::string written_endings() {
  return endings_text([](const Format& format) { return format.add && !format.of_fields; });
}

void bake(const Arguments& arguments, Files& files) {
  const Config config = arguments.config.load();
  const Table source = read_input(arguments.input, std::nullopt);
  if (!source.field)
    throw InputError(fmt::format(
        "{}: a table of nodes; expected a field, as `ltcfit generate --set field.size=1024` makes",
        one_line(arguments.input)));
  Table table =
      table_of_field(*source.field, config.grid, config.storage, {processor_count(), nullptr});
  table.field.reset();
  table.seed = source.seed;
  table.config = source.config;
  table.created = source.created;
  table.generator = generator();
  const NamedSet output = set_of(arguments.output);
  if (!output.format || !output.format->add || output.format->of_fields)
    throw InputError(fmt::format("-o {}: no suffix of a table; expected {}",
                                 one_line(arguments.output), written_endings()));
  const TextureLayout layout = resolved(arguments.options.layout, table.grid, table.storage);
  const TableFiles written = output.format->files(output.prefix, layout);
  for (const std::filesystem::path& file : written)
    files.write("-o", file);
  write_table(table, arguments.output, arguments.options);
  std::string text;
  for (const std::filesystem::path& file : written)
    text += fmt::format("wrote {}\n", one_line(file.string()));
  print(text);
}

}  // namespace

Action declare_bake(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_table_argument(app, "FIELD", arguments->input,
                     "field to read: _field.json, or the .h5 of one");
  add_config_options(app, arguments->config,
                     {.file = "config whose [table] says which grid and storage, others' sections "
                              "without effect [the paper's 8 x 8 x 8 x 8]",
                      .example = "table.alpha.nodes=16",
                      .group = "Which table"});
  allow(app.add_option("-o,--output", arguments->output, "file to write, " + written_endings()),
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
  return [arguments](Files& files) { bake(*arguments, files); };
}

}  // namespace ltc::cli
