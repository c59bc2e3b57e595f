// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/gradient_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace ltc {
namespace {

// The derivative by one entry; none where a kink lies within every step that was tried.
std::optional<double> central_difference(const SlicedWassersteinLoss& loss,
                                         const Eigen::Matrix3d& matrix, std::uint64_t piece,
                                         int row, int column, double step, int retries) {
  for (int attempt = 0; attempt <= retries; ++attempt, step *= 0.1) {
    Eigen::Matrix3d below = matrix, above = matrix;
    below(row, column) -= step;
    above(row, column) += step;
    const LossAndGradient low = loss(below), high = loss(above);
    if (low.piece == piece && high.piece == piece)
      // The step that was made, not the one that was meant: the sum above is rounded.
      return (high.loss - low.loss) / (above(row, column) - below(row, column));
  }
  return std::nullopt;
}

}  // namespace

int GradientCheck::undecided_count() const {
  return static_cast<int>(std::count(undecided.begin(), undecided.end(), true));
}

std::string GradientCheck::describe() const {
  std::string text = fmt::format(
      "gradient check {}: largest relative error {:.2g} at row {}, column {}",
      passed ? "passed" : "not passed", largest_relative_error, worst_row, worst_column);
  if (undecided_count() > 0)
    text += fmt::format("; {} of 9 entries undecided, a tie lies within the step of each",
                        undecided_count());
  return text;
}

GradientCheck check_gradient(const SlicedWassersteinLoss& loss, const Eigen::Matrix3d& matrix,
                             const Eigen::Matrix3d& gradient, const GradientCheckOptions& options) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  GradientCheck check;
  check.numeric.setConstant(nan);
  const LossAndGradient centre = loss(matrix);
  if (!std::isfinite(centre.loss) || !gradient.allFinite()) {
    check.largest_relative_error = nan;
    return check;
  }
  const double step = options.relative_step * matrix.norm();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const std::optional<double> numeric =
          central_difference(loss, matrix, centre.piece, row, column, step, options.retries);
      check.undecided[3 * row + column] = !numeric;
      check.numeric(row, column) = numeric.value_or(nan);
    }
  for (int column = 0; column < 3; ++column) {
    double scale = std::numeric_limits<double>::min();
    for (int row = 0; row < 3; ++row) {
      scale = std::max(scale, std::abs(gradient(row, column)));
      if (!check.undecided[3 * row + column])
        scale = std::max(scale, std::abs(check.numeric(row, column)));
    }
    for (int row = 0; row < 3; ++row) {
      if (check.undecided[3 * row + column])
        continue;
      const double error = std::abs(gradient(row, column) - check.numeric(row, column)) / scale;
      if (error > check.largest_relative_error) {
        check.largest_relative_error = error;
        check.worst_row = row;
        check.worst_column = column;
      }
    }
  }
  check.passed = check.undecided_count() == 0 && check.largest_relative_error <= options.tolerance;
  return check;
}

}  // namespace ltc
