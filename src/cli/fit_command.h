// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The command that looks into an entry of a table.
#pragma once

#include <Eigen/Core>
#include <string>

#include "cli/options.h"
#include "table/table.h"

namespace ltc::cli {

// Up to the entry's indices: "ltcfit fit --set fit.seed=2 --entry", with all that the table's own
// config says beside the defaults, so that it fits the entry as it was made. Empty if the config
// does not say the table's grid.
std::string fit_command_stem(const Table& table);

// The whole command; an entry of a table whose config does not say its grid is named by its lobe:
// "ltcfit fit --alpha-x 0.5 …".
std::string fit_command(const Table& table, const std::string& stem, std::size_t flat);

// A lobe by the numbers that the command line takes.
struct NamedLobe {
  double alpha_x, alpha_y, theta_degrees, phi_degrees;
};

// The command that fits this very lobe, every number to its last bit, from `start` as --start takes
// it (empty: the solver's own).
std::string fit_command(const ConfigArguments& config, const NamedLobe& lobe,
                        const std::string& start);

// "matrix=1,0,0,…": M by rows, as --start takes it, to the last bit.
std::string matrix_text(const Eigen::Matrix3d& matrix);

}  // namespace ltc::cli
