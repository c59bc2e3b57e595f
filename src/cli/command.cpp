// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/command.h"

#include <fmt/format.h>

#include "core/version.h"

namespace ltc::cli {

// One a file of the same name.
Action declare_generate(CLI::App& app);
Action declare_merge(CLI::App& app);
Action declare_fit(CLI::App& app);
Action declare_diff(CLI::App& app);
Action declare_validate(CLI::App& app);
Action declare_bench(CLI::App& app);
Action declare_render(CLI::App& app);
Action declare_view(CLI::App& app);
Action declare_convert(CLI::App& app);
Action declare_bake(CLI::App& app);
Action declare_lookup(CLI::App& app);
Action declare_prefilter(CLI::App& app);
Action declare_stress(CLI::App& app);
Action declare_completion(CLI::App& app);
Action declare_man(CLI::App& app);

namespace {

constexpr const char* about = "About";

void add_help_option(CLI::App& app) {
  app.set_help_flag("-h,--help", "print this help and exit")->group(about);
}

}  // namespace

std::span<const Command> commands() {
  static constexpr Command all[] = {
      {"generate", "Make a table", "fit a table and write it as HDF5, OpenEXR and NPY",
       declare_generate, true},
      {"merge", "Make a table", "put the shards of a table together and make the rest of it",
       declare_merge, true},
      {"fit", "Look into one lobe",
       "fit one entry or lobe and show every step, matrix and loss, and a picture", declare_fit},
      {"diff", "Compare and validate tables",
       "tell which of two tables is nearer to GGX, and where", declare_diff},
      {"validate", "Compare and validate tables",
       "check that a table is sound, and name the entries that are not", declare_validate},
      {"bench", "Compare and validate tables",
       "measure the run time and error of many settings in one run", declare_bench},
      {"stress", "Compare and validate tables",
       "fit at the extremes from good and bad starts, and count what fails", declare_stress},
      {"render", "Compare and validate tables",
       "render spheres and sheets with a table and with sampled GGX", declare_render},
      {"view", "Compare and validate tables",
       "make a page in which to look at tables under lights, beside GGX", declare_view},
      {"convert", "Use tables", "write a table in another format or layout", declare_convert},
      {"bake", "Use tables", "make a table of any grid from a field", declare_bake},
      {"lookup", "Use tables", "print what a table gives for the lobes of a file", declare_lookup},
      {"prefilter", "Use tables", "make the texture that shaders fetch for a light's image",
       declare_prefilter},
      {"completion", "Help at hand", "print a script by which bash, zsh or fish complete commands",
       declare_completion},
      {"man", "Help at hand", "print the manual page", declare_man},
  };
  return all;
}

DeclaredCommand declared(const Command& command) {
  auto app = std::make_unique<CLI::App>(command.summary, fmt::format("ltcfit {}", command.name));
  app->set_help_flag("");  // CLI11 puts its own first; help stands last
  Action action = command.declare(*app);
  add_help_option(*app);
  return {std::move(app), std::move(action)};
}

std::unique_ptr<CLI::App> program_options() {
  auto app = std::make_unique<CLI::App>(
      "ltcfit makes look-up tables of linearly transformed cosines (LTC) for anisotropic GGX.",
      "ltcfit");
  add_help_option(*app);
  app->set_version_flag("--version", generator(), "print version and commit and exit")
      ->group(about);
  return app;
}

}  // namespace ltc::cli
