// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/grid.h"

#include <algorithm>
#include <numbers>

namespace ltc {

Grid Grid::paper(std::size_t nodes_per_axis) {
  return paper({nodes_per_axis, nodes_per_axis, nodes_per_axis, nodes_per_axis});
}

Grid Grid::paper(const std::array<std::size_t, 4>& shape) {
  constexpr double quarter_turn = std::numbers::pi / 2;
  Grid grid;
  grid.alpha = Axis::make(0, 1, shape[0], Warp::linear);
  grid.lambda = Axis::make(0, 1, shape[1], Warp::linear);
  grid.theta = Axis::make(0, steepest_theta, shape[2], Warp::linear);
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

std::array<std::string_view, Grid::axis_count> Grid::axis_names() const {
  if (layout == Layout::alphax_alphay)
    return {"alpha_x", "alpha_y", "theta", "phi"};
  return {"alpha", "lambda", "theta", "phi"};
}

bool is_isotropic(const Grid& grid) {
  const auto only = [](const Axis& axis, double value) {
    return axis.size() == 1 && axis.first() == value;
  };
  return grid.layout == Layout::alpha_lambda && only(grid.lambda, 1) && only(grid.phi, 0);
}

std::array<std::size_t, Grid::axis_count> Grid::indices(std::size_t flat) const {
  const NodeIndex at = node(flat);
  return {at.alpha, at.lambda, at.theta, at.phi};
}

std::array<std::size_t, Grid::axis_count> Grid::strides() const {
  return {lambda.size() * theta.size() * phi.size(), theta.size() * phi.size(), phi.size(), 1};
}

std::optional<std::size_t> Grid::before(std::size_t flat, std::size_t axis) const {
  const std::size_t stride = strides()[axis];
  return flat / stride % shape()[axis] > 0 ? std::optional(flat - stride) : std::nullopt;
}

std::optional<std::size_t> Grid::after(std::size_t flat, std::size_t axis) const {
  const std::size_t stride = strides()[axis];
  return flat / stride % shape()[axis] + 1 < shape()[axis] ? std::optional(flat + stride)
                                                           : std::nullopt;
}

std::vector<std::size_t> Grid::neighbours(std::size_t flat) const {
  std::vector<std::size_t> result;
  result.reserve(2 * axis_count);
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    for (const auto next : {before(flat, axis), after(flat, axis)})
      if (next)
        result.push_back(*next);
  return result;
}

Lobe Grid::lobe(const NodeIndex& node) const {
  const double larger = alpha.nodes[node.alpha];  // of the two, or alpha_x
  Lobe lobe;
  lobe.alpha_x = std::max(larger, alpha_min);
  const double second = lambda.nodes[node.lambda];
  lobe.alpha_y = std::max(layout == Layout::alphax_alphay ? second : second * larger, alpha_min);
  constexpr double horizon = std::numbers::pi / 2 * (1 - 1e-12);
  const double angle = theta.nodes[node.theta];
  lobe.theta_radians = angle < horizon ? angle : steepest_theta;
  lobe.phi_radians = phi.nodes[node.phi];
  lobe.model = model;
  return lobe;
}

}  // namespace ltc
