// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/lookup.h"

#include <algorithm>
#include <cmath>

namespace ltc {
namespace {

// Where a value stands between two neighbouring nodes of an axis.
struct Bracket {
  std::array<std::size_t, 2> nodes;
  std::array<double, 2> weights;
};
Bracket bracket(const Axis& axis, double value) {
  const double position = axis.position(value);
  if (std::isnan(position))
    return {{0, 0}, {position, position}};
  const auto lower = static_cast<std::size_t>(position);
  const std::size_t upper = std::min(lower + 1, axis.size() - 1);
  const double weight = position - static_cast<double>(lower);
  return {{lower, upper}, {1 - weight, weight}};
}

// What the query's roughness is to the table: as at the nodes, never below alpha_min.
Lobe bounded_below(Lobe lobe, double alpha_min) {
  lobe.alpha_x = std::max(lobe.alpha_x, alpha_min);
  lobe.alpha_y = std::max(lobe.alpha_y, alpha_min);
  return lobe;
}

}  // namespace

Interpolation interpolation(const Grid& grid, const Lobe& folded) {
  // The roughness as asked for: `alpha_min` bounds the lobe at a node, not the place of a node, so
  // one below it belongs between the nodes that its own value or ratio names.
  const std::array brackets{
      bracket(grid.alpha, folded.alpha_x), bracket(grid.lambda, second_roughness(grid, folded)),
      bracket(grid.theta, folded.theta_radians), bracket(grid.phi, folded.phi_radians)};
  const auto strides = grid.strides();
  Interpolation result;
  for (std::size_t corner = 0; corner < result.nodes.size(); ++corner) {
    std::size_t node = 0;
    double weight = 1;
    for (std::size_t axis = 0; axis < Grid::axis_count; ++axis) {
      const std::size_t side = corner >> (Grid::axis_count - 1 - axis) & 1;
      node += brackets[axis].nodes[side] * strides[axis];
      weight *= brackets[axis].weights[side];
    }
    result.nodes[corner] = node;
    result.weights[corner] = weight;
  }
  return result;
}

LookUp look_up(const Table& table, const Lobe& lobe) {
  if (table.field) {
    const FoldedLobe folded = fold(lobe);
    const FieldLobe found = lobe_of(*table.field, folded.lobe);
    return {folded.unfold * found.matrix, found.amplitude, found.fresnel, found.fold,
            table.field->creases};
  }
  const FoldedLobe folded = Reduction(table.grid).fold(lobe);
  const Interpolation corners = interpolation(table.grid, folded.lobe);
  Eigen::Matrix3d stored = Eigen::Matrix3d::Zero();
  LookUp result{Eigen::Matrix3d::Zero(), 0, 0};
  double kappa = 0, gamma = 0;
  for (std::size_t corner = 0; corner < corners.nodes.size(); ++corner) {
    const double weight = corners.weights[corner];
    if (weight == 0)
      continue;  // 0 times the NaN of a skipped node would be NaN
    const std::size_t node = corners.nodes[corner];
    stored += weight * table.stored_at(node);
    result.amplitude += weight * table.amplitude[node];
    result.fresnel += weight * table.fresnel[node];
    if (is_folded(table)) {
      kappa += weight * table.fold[2 * node];
      gamma += weight * table.fold[2 * node + 1];
    }
  }
  const Lobe bounded = bounded_below(folded.lobe, table.grid.alpha_min);
  result.matrix = folded.unfold * matrix_from_stored(table.storage, stored, bounded);
  result.fold = fold_of(kappa, gamma, bounded, table.creases);
  result.creases = table.creases;
  return result;
}

}  // namespace ltc
