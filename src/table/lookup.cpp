// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/lookup.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ltc {
namespace {

constexpr double quarter_turn = std::numbers::pi / 2;
constexpr double half_turn = std::numbers::pi;
constexpr double full_turn = 2 * std::numbers::pi;

// The same azimuth in [0, 2 pi).
double wrapped(double phi_radians) {
  double phi = std::fmod(phi_radians, full_turn);
  if (phi < 0)
    phi += full_turn;
  // A tiny negative azimuth rounds to the full turn itself.
  return phi >= full_turn ? 0.0 : phi;
}

// Equation (13): the azimuth of the first quadrant, and the signs of x and y that lead back.
struct FoldedAzimuth {
  double phi_radians;
  double sign_x, sign_y;
};
FoldedAzimuth fold_azimuth(double phi_radians) {
  const double phi = wrapped(phi_radians);
  if (phi < quarter_turn)
    return {phi, 1, 1};
  if (phi < half_turn)
    return {half_turn - phi, -1, 1};
  if (phi < half_turn + quarter_turn)
    return {phi - half_turn, -1, -1};
  return {full_turn - phi, 1, -1};
}

// Equation (13) alone.
FoldedLobe mirrored(const GgxLobe& lobe) {
  const FoldedAzimuth azimuth = fold_azimuth(lobe.phi_radians);
  FoldedLobe folded{lobe, Eigen::Vector3d(azimuth.sign_x, azimuth.sign_y, 1).asDiagonal()};
  folded.lobe.phi_radians = azimuth.phi_radians;
  return folded;
}

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

// The ratio of the roughnesses as asked for: `alpha_min` bounds the lobe at a node, not the place
// of a node, so a roughness below it belongs between the nodes that its own ratio names. At zero
// roughness every ratio is the same lobe; 1 is the one that takes no lower bound to be so.
double roughness_ratio(const GgxLobe& folded) {
  return folded.alpha_x == 0 ? 1.0 : folded.alpha_y / folded.alpha_x;
}

// Where a folded lobe stands on the second axis.
double second_roughness(const Grid& grid, const GgxLobe& folded) {
  return grid.layout == Layout::alphax_alphay ? folded.alpha_y : roughness_ratio(folded);
}

bool within(const Axis& axis, double value) {
  constexpr double no_matter = 1e-3;
  return value >= axis.first() - no_matter && value <= axis.last() + no_matter;
}

// What the query's roughness is to the table: as at the nodes, never below alpha_min.
GgxLobe bounded_below(GgxLobe lobe, double alpha_min) {
  lobe.alpha_x = std::max(lobe.alpha_x, alpha_min);
  lobe.alpha_y = std::max(lobe.alpha_y, alpha_min);
  return lobe;
}

}  // namespace

FoldedLobe fold(const Grid& grid, const GgxLobe& lobe) {
  return grid.layout == Layout::alphax_alphay ? mirrored(lobe) : fold(lobe);
}

FoldedLobe fold(const GgxLobe& lobe) {
  FoldedLobe folded = mirrored(lobe);
  if (lobe.alpha_y > lobe.alpha_x) {
    std::swap(folded.lobe.alpha_x, folded.lobe.alpha_y);
    folded.lobe.phi_radians = quarter_turn - folded.lobe.phi_radians;
    // Equation (14) stands inside equation (13), so the swap applies first: its columns swap here.
    folded.unfold.col(0).swap(folded.unfold.col(1));
  }
  return folded;
}

Interpolation interpolation(const Grid& grid, const GgxLobe& folded) {
  const Bracket alpha = bracket(grid.alpha, folded.alpha_x);
  const Bracket lambda = bracket(grid.lambda, second_roughness(grid, folded));
  const Bracket theta = bracket(grid.theta, folded.theta_radians);
  const Bracket phi = bracket(grid.phi, folded.phi_radians);
  Interpolation result;
  for (std::size_t corner = 0; corner < 16; ++corner) {
    const std::size_t a = corner >> 3 & 1, l = corner >> 2 & 1, t = corner >> 1 & 1, p = corner & 1;
    result.nodes[corner] =
        grid.flat({alpha.nodes[a], lambda.nodes[l], theta.nodes[t], phi.nodes[p]});
    result.weights[corner] =
        alpha.weights[a] * lambda.weights[l] * theta.weights[t] * phi.weights[p];
  }
  return result;
}

bool covers(const Grid& grid, const GgxLobe& folded) {
  return within(grid.alpha, folded.alpha_x) &&
         within(grid.lambda, second_roughness(grid, folded)) &&
         within(grid.theta, folded.theta_radians) && within(grid.phi, folded.phi_radians);
}

LookUp look_up(const Table& table, const GgxLobe& lobe) {
  const FoldedLobe folded = fold(table.grid, lobe);
  const Interpolation corners = interpolation(table.grid, folded.lobe);
  Eigen::Matrix3d stored = Eigen::Matrix3d::Zero();
  LookUp result{Eigen::Matrix3d::Zero(), 0, 0};
  for (std::size_t corner = 0; corner < corners.nodes.size(); ++corner) {
    const double weight = corners.weights[corner];
    if (weight == 0)
      continue;  // 0 times the NaN of a skipped node would be NaN
    const std::size_t node = corners.nodes[corner];
    stored += weight * table.stored_at(node);
    result.amplitude += weight * table.amplitude[node];
    result.fresnel += weight * table.fresnel[node];
  }
  const GgxLobe bounded = bounded_below(folded.lobe, table.grid.alpha_min);
  result.matrix = folded.unfold * matrix_from_stored(table.storage, stored, bounded);
  return result;
}

}  // namespace ltc
