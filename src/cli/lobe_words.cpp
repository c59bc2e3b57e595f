// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/lobe_words.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "core/angle.h"
#include "core/shell_quoted.h"
#include "judge/matrix_invariants.h"
#include "table/entry_text.h"

namespace ltc::cli {
namespace {

double degrees(double radians) {
  return radians / radians_per_degree;
}

}  // namespace

std::string lobe_line(const Lobe& lobe) {
  return fmt::format("alpha_x {:.6g}, alpha_y {:.6g}, theta {:.6g}, phi {:.6g}", lobe.alpha_x,
                     lobe.alpha_y, degrees(lobe.theta_radians), degrees(lobe.phi_radians));
}

std::string query_command(const std::string& file, const Lobe& lobe) {
  return fmt::format(
      "ltcfit fit --as-in {} --alpha-x {:.9g} --alpha-y {:.9g} --theta {:.9g} --phi {:.9g}",
      shell_quoted(file), lobe.alpha_x, lobe.alpha_y, degrees(lobe.theta_radians),
      degrees(lobe.phi_radians));
}

std::string entry_command(const std::string& file, const Grid& grid, std::size_t flat) {
  return fmt::format("ltcfit fit --as-in {} --entry {}", shell_quoted(file),
                     entry_text(grid, flat));
}

std::string matrix_text(const std::string& name, const Eigen::Matrix3d& matrix) {
  std::string text;
  for (int row = 0; row < 3; ++row)
    text += fmt::format("{:<9}{:>16.8e} {:>16.8e} {:>16.8e}\n", row == 0 ? name : "",
                        matrix(row, 0), matrix(row, 1), matrix(row, 2));
  return text + fmt::format("{:<9}determinant {:.4e}, condition number {:.4e}\n", "",
                            matrix.determinant(), condition_number(matrix));
}

std::string loss_words(double held_out_loss, double spread) {
  return fmt::format("{:.4e} held out, {:.3g} % of the lobe's spread {:.4e}", held_out_loss,
                     100 * held_out_loss / spread, spread);
}

nlohmann::ordered_json lobe_json(const Lobe& lobe) {
  return {{"alpha_x", lobe.alpha_x},
          {"alpha_y", lobe.alpha_y},
          {"theta_degrees", degrees(lobe.theta_radians)},
          {"phi_degrees", degrees(lobe.phi_radians)}};
}

nlohmann::ordered_json matrix_json(const Eigen::Matrix3d& matrix) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (int row = 0; row < 3; ++row)
    rows.push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2)});
  return rows;
}

nlohmann::ordered_json range_json(const QueryRange& range) {
  return {{"roughness", {range.roughness_first, range.roughness_last}},
          {"lambda", {range.lambda_first, range.lambda_last}},
          {"cos_theta", {range.cos_theta_first, range.cos_theta_last}},
          {"phi_degrees", {degrees(range.phi_first), degrees(range.phi_last)}}};
}

std::string range_words(const QueryRange& range) {
  return fmt::format(
      "perceptual roughness {:.3g} to {:.3g}, lambda {:.3g} to {:.3g}, theta {:.3g} to {:.3g}, phi "
      "{:.3g} to {:.3g}",
      range.roughness_first, range.roughness_last, range.lambda_first, range.lambda_last,
      degrees(std::acos(range.cos_theta_last)), degrees(std::acos(range.cos_theta_first)),
      degrees(range.phi_first), degrees(range.phi_last));
}

}  // namespace ltc::cli
