// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit bake: a field's values at the nodes of any grid, as a table.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/command.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/roughness_options.h"
#include "cli/table_input.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/version.h"
#include "export/table_file.h"
#include "refine/field_fit.h"
#include "table/field_table.h"

namespace ltc::cli {
namespace {

struct Arguments {
  std::string input, output, material;
  ConfigArguments config;
  WriteOptions options;
};

// JSON and functions.
bool can_hold_material(const Format& format) {
  return format.of_materials;
}

std::string written_endings() {
  return endings_text([](const Format& format) { return format.add && !format.of_fields; });
}

// Of what a contraction may have.
constexpr std::size_t material_size = 60;

Table baked(const Arguments& arguments, const Table& source) {
  const Config config = arguments.config.load();
  Table table =
      table_of_field(*source.field, config.grid, config.storage, {processor_count(), nullptr});
  table.field.reset();
  return table;
}

// For the one material that a draw call has.
Table contracted(const Arguments& arguments, const Table& source) {
  const double least = source.field->alpha_min;
  const LobeRoughness roughness = parse_roughness("--material", arguments.material, least);
  FieldReport report;
  const Field field =
      contracted_field(*source.field, std::max(roughness.alpha_x, roughness.alpha_y),
                       std::min(roughness.alpha_x, roughness.alpha_y), material_size,
                       {processor_count(), nullptr}, &report);
  tell(
      fmt::format("bake: {} numbers of the field's {}; mean relative loss {:.4f}, the field's "
                  "{:.4f}; amplitude off by {:.1e} in the mean, Fresnel term by {:.1e}\n",
                  field.terms.size(), source.field->terms.size(), report.loss, report.whole_loss,
                  report.amplitude_error, report.fresnel_error));
  return table_of_field(field, Grid::paper(), Storage::matrix, {processor_count(), nullptr});
}

NamedSet output_of(const Arguments& arguments) {
  const bool of_material = !arguments.material.empty();
  const NamedSet output = set_to_write(arguments.output, of_material);
  const bool fits = output.format && output.format->add &&
                    (of_material ? can_hold_material(*output.format) : !output.format->of_fields);
  if (!fits)
    throw InputError(
        fmt::format("-o {}: no suffix of a {}; expected {}", one_line(arguments.output),
                    of_material ? "field" : "table",
                    of_material ? endings_text(can_hold_material) : written_endings()));
  return output;
}

void bake(const Arguments& arguments, Files& files) {
  const Table source = read_input(arguments.input, std::nullopt);
  if (!source.field || source.field->material)
    throw InputError(fmt::format(
        "{}: {}; expected a field, as `ltcfit generate --set "
        "field.size=1024` makes",
        one_line(arguments.input), source.field ? "a field of one material" : "a table of nodes"));
  const NamedSet output = output_of(arguments);
  Table table =
      arguments.material.empty() ? baked(arguments, source) : contracted(arguments, source);
  table.seed = source.seed;
  table.config = source.config;
  table.created = source.created;
  table.generator = generator();
  write_output(table, output, arguments.options, files);
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
  app.add_option("--material", arguments->material,
                 "the field of one material instead, 60 numbers of theta and phi: its roughnesses, "
                 "or roughness=R,anisotropy=A")
      ->option_text("X,Y")
      ->group("Which table");
  allow(app.add_option("-o,--output", arguments->output,
                       "file to write, " + written_endings() + "; with --material " +
                           endings_text(can_hold_material)),
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
