// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/grid.h"

#include <algorithm>
#include <numbers>

namespace ltc {

std::string_view layout_name(Layout layout) {
  return layout == Layout::alphax_alphay ? "alphax-alphay" : "alpha-lambda";
}

Grid Grid::paper(std::size_t nodes_per_axis) {
  return paper({nodes_per_axis, nodes_per_axis, nodes_per_axis, nodes_per_axis});
}

Grid Grid::paper(const std::array<std::size_t, 4>& shape) {
  constexpr double quarter_turn = std::numbers::pi / 2;
  Grid grid;
  grid.alpha = Axis::make(0, 1, shape[0], Warp::linear);
  grid.lambda = Axis::make(0, 1, shape[1], Warp::linear);
  grid.theta = Axis::make(0, 0.9999 * quarter_turn, shape[2], Warp::linear);
  grid.phi = Axis::make(0, quarter_turn, shape[3], Warp::linear);
  return grid;
}

std::size_t Grid::flat(const NodeIndex& node) const {
  return ((node.alpha * lambda.size() + node.lambda) * theta.size() + node.theta) * phi.size() +
         node.phi;
}

NodeIndex Grid::node(std::size_t flat) const {
  NodeIndex node;
  node.phi = flat % phi.size();
  flat /= phi.size();
  node.theta = flat % theta.size();
  flat /= theta.size();
  node.lambda = flat % lambda.size();
  node.alpha = flat / lambda.size();
  return node;
}

GgxLobe Grid::lobe(const NodeIndex& node) const {
  const double larger = alpha.nodes[node.alpha];  // of the two, or alpha_x
  GgxLobe lobe;
  lobe.alpha_x = std::max(larger, alpha_min);
  const double second = lambda.nodes[node.lambda];
  lobe.alpha_y = std::max(layout == Layout::alphax_alphay ? second : second * larger, alpha_min);
  lobe.theta_radians = theta.nodes[node.theta];
  lobe.phi_radians = phi.nodes[node.phi];
  return lobe;
}

}  // namespace ltc
