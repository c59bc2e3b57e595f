// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The four axes of a table and the lobe that stands at each node.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "brdf/ggx.h"
#include "table/axis.h"

namespace ltc {

// Node of a grid, in the order of the files: alpha, lambda, theta, phi.
struct NodeIndex {
  std::size_t alpha = 0, lambda = 0, theta = 0, phi = 0;
  bool operator==(const NodeIndex&) const = default;
};

// What the first two axes hold.
enum class Layout {
  alpha_lambda,   // the larger roughness, and the ratio of the smaller to it
  alphax_alphay,  // both roughnesses; read only, of the other published table
};
constexpr EnumNames<Layout, 2> enum_names(Layout) {
  return {"layout",
          {{{Layout::alpha_lambda, "alpha-lambda"}, {Layout::alphax_alphay, "alphax-alphay"}}}};
}

// The last view of the paper's grid.
inline constexpr double steepest_theta = 0.9999 * std::numbers::pi / 2;

// Axes: alpha is the larger roughness, lambda the ratio of the smaller to the larger, theta and phi
// the view direction in radians. alpha_x = max(alpha, alpha_min), alpha_y = max(lambda alpha,
// alpha_min). With layout alphax_alphay, alpha is the axis of alpha_x and lambda that of alpha_y.
struct Grid {
  Layout layout = Layout::alpha_lambda;
  Axis alpha, lambda, theta, phi;
  double alpha_min = 1e-4;
  const LobeModel* model = &ggx();  // of the lobes at its nodes

  // The paper's grid: alpha and lambda on [0, 1], theta on [0, 0.9999 pi/2], phi on [0, pi/2], all
  // linear with `nodes_per_axis` nodes.
  static Grid paper(std::size_t nodes_per_axis = 8);
  // The same ranges with (alpha, lambda, theta, phi) node counts of their own.
  static Grid paper(const std::array<std::size_t, 4>& shape);

  // The axes by number, in the order of the files, and what they hold: "alpha", "lambda" or
  // "alpha_x", "alpha_y"; then "theta", "phi".
  static constexpr std::size_t axis_count = 4;
  Axis& axis(std::size_t number) { return *std::array{&alpha, &lambda, &theta, &phi}.at(number); }
  const Axis& axis(std::size_t number) const { return const_cast<Grid&>(*this).axis(number); }
  std::array<std::string_view, axis_count> axis_names() const;

  std::size_t size() const { return alpha.size() * lambda.size() * theta.size() * phi.size(); }
  std::array<std::size_t, 4> shape() const {
    return {alpha.size(), lambda.size(), theta.size(), phi.size()};
  }

  // Flat index of a node in C order (phi fastest), and back.
  std::size_t flat(const NodeIndex& node) const;
  NodeIndex node(std::size_t flat) const;

  std::array<std::size_t, axis_count> indices(std::size_t flat) const;
  // Steps of the flat index from node to node along each axis.
  std::array<std::size_t, axis_count> strides() const;
  // The node next to one along an axis; none at the axis' end.
  std::optional<std::size_t> before(std::size_t flat, std::size_t axis) const;
  std::optional<std::size_t> after(std::size_t flat, std::size_t axis) const;
  // All of these, axis by axis: the nodes that share a face with this one.
  std::vector<std::size_t> neighbours(std::size_t flat) const;

  // A node of theta = pi/2, where nothing is seen, stands for the paper's last view,
  // steepest_theta.
  Lobe lobe(const NodeIndex& node) const;
  Lobe lobe(std::size_t flat) const { return lobe(node(flat)); }

  bool operator==(const Grid&) const = default;
};

// Whether lambda = 1 and phi = 0 are the only nodes: a table of isotropic lobes.
bool is_isotropic(const Grid& grid);

}  // namespace ltc
