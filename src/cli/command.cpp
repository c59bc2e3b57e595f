// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/command.h"

namespace ltc::cli {

// One a file of the same name.
Action declare_generate(CLI::App& app);
Action declare_fit(CLI::App& app);
Action declare_diff(CLI::App& app);
Action declare_validate(CLI::App& app);
Action declare_bench(CLI::App& app);
Action declare_render(CLI::App& app);
Action declare_stress(CLI::App& app);

std::span<const Command> commands() {
  static constexpr Command all[] = {
      {"generate", "Make a table", "fit a table and write it as HDF5, OpenEXR and NPY",
       declare_generate},
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
      {"render", "Compare and validate tables", "render spheres with a table and with sampled GGX",
       declare_render},
  };
  return all;
}

}  // namespace ltc::cli
