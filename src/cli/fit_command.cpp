// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/fit_command.h"

#include <fmt/format.h>

#include "cli/output.h"
#include "config/overrides.h"
#include "core/angle.h"
#include "core/error.h"
#include "table/entry_text.h"

namespace ltc::cli {

std::string fit_command_stem(const Table& table) {
  const ConfigArguments arguments{"", overrides_of(table.config)};
  try {
    if (arguments.load().grid == table.grid)
      return "ltcfit fit" + arguments.as_text() + " --entry";
  } catch (const InputError&) {
    // A config of another version of the program, with values that this one does not take.
  }
  return "";
}

std::string fit_command(const Table& table, const std::string& stem, std::size_t flat) {
  if (!stem.empty())
    return stem + " " + entry_text(table.grid, flat);
  const GgxLobe lobe = table.grid.lobe(table.grid.node(flat));
  return fmt::format("ltcfit fit --alpha-x {:.6g} --alpha-y {:.6g} --theta {:.6g} --phi {:.6g}",
                     lobe.alpha_x, lobe.alpha_y, lobe.theta_radians / radians_per_degree,
                     lobe.phi_radians / radians_per_degree);
}

std::string fit_command(const ConfigArguments& config, const NamedLobe& lobe,
                        const std::string& start) {
  return fmt::format("ltcfit fit{} --alpha-x {} --alpha-y {} --theta {} --phi {}{}",
                     config.as_text(), lobe.alpha_x, lobe.alpha_y, lobe.theta_degrees,
                     lobe.phi_degrees, start.empty() ? "" : " --start " + shell_quoted(start));
}

std::string matrix_text(const Eigen::Matrix3d& matrix) {
  std::string text;
  for (int entry = 0; entry < 9; ++entry)
    text += fmt::format("{}{}", entry == 0 ? "matrix=" : ",", matrix(entry / 3, entry % 3));
  return text;
}

}  // namespace ltc::cli
