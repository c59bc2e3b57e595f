// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/entry_text.h"

#include <fmt/format.h>

#include <numbers>

namespace ltc {

std::string entry_text(const Grid& grid, std::size_t flat) {
  const NodeIndex node = grid.node(flat);
  return fmt::format("{},{},{},{}", node.alpha, node.lambda, node.theta, node.phi);
}

std::string lobe_text(const Grid& grid, std::size_t flat) {
  constexpr double degrees = 180 / std::numbers::pi;
  const NodeIndex node = grid.node(flat);
  const bool both = grid.layout == Layout::alphax_alphay;
  return fmt::format("{} {:.3f}, {} {:.3f}, theta {:.1f}, phi {:.1f}", both ? "alpha_x" : "alpha",
                     grid.alpha.nodes[node.alpha], both ? "alpha_y" : "lambda",
                     grid.lambda.nodes[node.lambda], grid.theta.nodes[node.theta] * degrees,
                     grid.phi.nodes[node.phi] * degrees);
}

}  // namespace ltc
