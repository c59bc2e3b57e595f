// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/half_precision.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <optional>

#include "judge/shader_inverse.h"
#include "table/entry_text.h"

namespace ltc {
namespace {

// The entry of the largest error that `allowed` takes, if there is one.
template <typename Allowed>
std::optional<std::size_t> worst(const std::vector<double>& errors, Allowed&& allowed) {
  std::optional<std::size_t> found;
  for (std::size_t flat = 0; flat < errors.size(); ++flat)
    if (!std::isnan(errors[flat]) && allowed(flat) && (!found || errors[flat] > errors[*found]))
      found = flat;
  return found;
}

}  // namespace

std::vector<double> half_precision_errors(const Table& table, const std::vector<bool>& judged,
                                          const RunContext& run) {
  const auto seen = [&](std::size_t flat, const LobeFrame& frame) -> LtcLobe {
    const Eigen::Matrix3d exact = table.stored_at(flat), kept = rounded(exact, Precision::half);
    if (!(kept.determinant() * exact.determinant() > 0))
      return Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
    LtcLobe lobe = matrix_from_stored(table.storage, kept, frame.lobe);
    if (is_folded(table)) {
      lobe.fold =
          fold_of(rounded(table.fold[2 * flat], Precision::half),
                  rounded(table.fold[2 * flat + 1], Precision::half), frame.lobe, table.creases);
      lobe.creases = table.creases;
    }
    return lobe;
  };
  return inversion_errors(table, judged, "half precision", run, seen);
}

std::string half_precision_text(const Grid& grid, const std::vector<double>& errors) {
  const std::optional<std::size_t> first = worst(errors, [](std::size_t) { return true; });
  if (!first)
    return "";
  const std::size_t alpha = grid.node(*first).alpha;
  std::string text =
      std::isfinite(errors[*first])
          ? fmt::format("16 bits move lobes by up to {:.2g} of their spread", errors[*first])
          : std::string("16 bits make a matrix singular, mirrored or infinite");
  text += fmt::format(", at entry {} ({})", entry_text(grid, *first), lobe_text(grid, *first));
  const std::optional<std::size_t> elsewhere =
      worst(errors, [&](std::size_t flat) { return grid.node(flat).alpha != alpha; });
  return elsewhere ? fmt::format("{}; at other alpha by up to {:.2g}", text, errors[*elsewhere])
                   : text;
}

}  // namespace ltc
