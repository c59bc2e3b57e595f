// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How reports write lobes, their parts and ranges of them.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>

#include "brdf/ggx.h"
#include "table/queries.h"
#include "table/table.h"

namespace ltc::cli {

// "alpha_x 0.4, alpha_y 0.1, theta 60, phi 30", in degrees.
std::string lobe_line(const Lobe& lobe);

// The command that shows what the table in a file gives for a lobe, and an LTC fitted to that very
// lobe beside it: "ltcfit fit --as-in out/ltc.h5 --alpha-x 0.04 …"; and the one for its entry.
std::string query_command(const std::string& file, const Lobe& lobe);
std::string entry_command(const std::string& file, const Grid& grid, std::size_t flat);

// Four lines: the rows behind `name`, then determinant and condition number.
std::string matrix_text(const std::string& name, const Eigen::Matrix3d& matrix);

// "1.2e-02 held out, 13 % of the lobe's spread 9.2e-02".
std::string loss_words(double held_out_loss, double spread);

nlohmann::ordered_json lobe_json(const Lobe& lobe);
nlohmann::ordered_json matrix_json(const Eigen::Matrix3d& matrix);  // rows; null for NaN

nlohmann::ordered_json range_json(const QueryRange& range);  // from and to, angles in degrees

// "perceptual roughness 0.1 to 1, lambda 0 to 1, theta 0 to 90, phi 0 to 90", angles in degrees.
std::string range_words(const QueryRange& range);

}  // namespace ltc::cli
