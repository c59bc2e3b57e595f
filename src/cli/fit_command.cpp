// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/fit_command.h"

#include <fmt/format.h>

#include <optional>

#include "cli/output.h"
#include "config/config.h"
#include "core/angle.h"
#include "core/error.h"
#include "table/entry_text.h"

namespace ltc::cli {
namespace {

// Nothing where the table has no config, or one of another version of the program, with values that
// this one does not take.
std::optional<Config> config_of(const Table& table) {
  if (table.config.empty())
    return std::nullopt;
  try {
    return parse_config(table.config, "the table's config", {});
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

EntryCommands::EntryCommands(const std::string& file, const Table& table)
    : table_(table), file_(shell_quoted(file)) {
  const std::optional<Config> config = config_of(table);
  // The config of an extended table is followed by that of its older entries.
  // A field's nodes are no fits.
  has_config_ = config && config->grid == table.grid && table.config == to_toml(*config) &&
                config->field.size == 0;
  // What the config asks for is all that files of older versions tell.
  refined_ = table.refined.value_or(config && config->refine.steps > 0);
}

std::string EntryCommands::stored(std::size_t flat) const {
  return fmt::format("ltcfit fit --as-in {} --entry {}", file_, entry_text(table_.grid, flat));
}

std::string EntryCommands::fitted(std::size_t flat) const {
  return has_config_ ? fmt::format("ltcfit fit --config {} --entry {}", file_,
                                   entry_text(table_.grid, flat))
                     : "";
}

std::string EntryCommands::best(std::size_t flat) const {
  return has_config_ && !refined_ ? fitted(flat) : stored(flat);
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
