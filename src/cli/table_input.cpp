// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/table_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "brdf/lobe_model.h"
#include "cli/options.h"
#include "cli/output.h"
#include "core/error.h"
#include "export/table_file.h"
#include "pipeline/require_model.h"

namespace ltc::cli {

void add_layout_option(CLI::App& app, std::optional<ReadAs>& as) {
  std::vector<std::string> axes = all_names<Layout>(), names = axes;
  for (const std::string& name : all_names<TextureLayout>())
    if (value_named<TextureLayout>(name) != TextureLayout::automatic)
      names.push_back(name);
  const auto set = [&as, axes](const std::string& name) {
    if (!as)
      as.emplace();
    if (std::ranges::find(axes, name) != axes.end())
      as->axes = value_named<Layout>(name);
    else
      as->textures = value_named<TextureLayout>(name);
  };
  CLI::Option* const option = app.add_option_function<std::string>(
      "--layout", set,
      fmt::format(
          "what files hold that do not say it: the first two axes of an {}, alpha-lambda "
          "or alphax-alphay [by the symmetry of alpha_x and alpha_y]; textures, one of {} "
          "[by their shapes and by where their lobes lie]",
          endings_text([](const Format& format) { return format.without_axes; }),
          fmt::join(names.begin() + static_cast<std::ptrdiff_t>(axes.size()), names.end(), ", ")));
  allow_names(option, names)->option_text("LAYOUT")->group("How to read tables");
  app.add_option_function<std::string>(
         "--brdf",
         [&as](const std::string& name) {
           if (!as)
             as.emplace();
           as->model = &lobe_model(name);
         },
         "the BRDF of files that do not name theirs, by which they are judged, as table.brdf has "
         "it [ggx]")
      ->option_text("NAME")
      ->group("How to read tables");
}

Table read_input(const std::string& file, const std::optional<ReadAs>& as, FoldedLobes folded) {
  Table table = read_table(file, as.value_or(ReadAs{}));
  if (is_folded(table) && folded == FoldedLobes::refused)
    throw InputError(fmt::format(
        "{}: its lobes are folded; expected a table or field of plain ones (docs/folded.md)",
        one_line(file)));
  if (as && as->model)
    try {
      require_lobes(table.grid);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", one_line(file), error.what()));
    }
  // A line that cannot be written is no reason to stop.
  const bool told = as && (as->axes || as->textures != TextureLayout::automatic);
  if (!told && !table.read_as.empty())
    std::fputs(fmt::format("{}: {}\n", one_line(file), table.read_as).c_str(), stderr);
  return table;
}

void write_output(const Table& table, const NamedSet& output, const WriteOptions& options,
                  Files& files) {
  const TableFiles written =
      output.format->files(output.prefix, table.grid, table.storage, options.layout);
  for (const std::filesystem::path& file : written)
    files.write("-o", file);
  platform::FileSet set;
  add_table(set, table, *output.format, output.prefix, options);
  set.commit();
  std::string text;
  for (const std::filesystem::path& file : written)
    text += fmt::format("wrote {}\n", one_line(file.string()));
  print(text);
}

}  // namespace ltc::cli
