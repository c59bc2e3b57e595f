// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/entry_text.h"

#include <fmt/format.h>

#include <numbers>

namespace ltc {

std::string entry_text(const Grid& grid, std::size_t flat) {
  return fmt::format("{}", fmt::join(grid.indices(flat), ","));
}

std::string shape_text(const Grid& grid, std::string_view between) {
  return fmt::format("{}", fmt::join(grid.shape(), between));
}

std::string lobe_text(const Grid& grid, std::size_t flat) {
  constexpr double degrees = 180 / std::numbers::pi;
  const NodeIndex node = grid.node(flat);
  const auto [first, second, theta, phi] = grid.axis_names();
  const double theta_degrees = grid.theta.nodes[node.theta] * degrees;
  // The paper's last node is at 89.991, and at 90 there is no lobe.
  return fmt::format("{} {:.3f}, {} {:.3f}, {} {:.{}f}, {} {:.1f}", first,
                     grid.alpha.nodes[node.alpha], second, grid.lambda.nodes[node.lambda], theta,
                     theta_degrees, theta_degrees >= 89.95 ? 3 : 1, phi,
                     grid.phi.nodes[node.phi] * degrees);
}

}  // namespace ltc
