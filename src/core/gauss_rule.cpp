// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/gauss_rule.h"

#include <cmath>
#include <numbers>

namespace ltc {

std::vector<GaussNode> gauss_nodes(std::size_t count) {
  std::vector<GaussNode> nodes(count);
  const auto n = static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 50; ++iteration) {
      double before = 1, value = x;
      for (std::size_t k = 2; k <= count; ++k) {
        const auto degree = static_cast<double>(k);
        const double next = ((2 * degree - 1) * x * value - (degree - 1) * before) / degree;
        before = value;
        value = next;
      }
      slope = n * (x * value - before) / (x * x - 1);
      const double step = value / slope;
      x -= step;
      if (std::abs(step) < 1e-15)
        break;
    }
    nodes[i] = {x, 2 / ((1 - x * x) * slope * slope)};
  }
  return nodes;
}

std::vector<GaussNode> gauss_nodes_of_unit(std::size_t count) {
  std::vector<GaussNode> nodes = gauss_nodes(count);
  for (GaussNode& node : nodes)
    node = {(1 + node.place) / 2, node.weight / 2};
  return nodes;
}

}  // namespace ltc
