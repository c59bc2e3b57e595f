// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/symmetry_plan.h"

#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "table/symmetry.h"

namespace ltc {
namespace {

// For each pair of nodes of alpha and lambda, in the grid's order, the first with its roughnesses.
std::vector<std::size_t> first_of_roughness(const Grid& grid) {
  std::map<std::pair<double, double>, std::size_t> first;
  std::vector<std::size_t> result;
  for (std::size_t alpha = 0; alpha < grid.alpha.size(); ++alpha)
    for (std::size_t lambda = 0; lambda < grid.lambda.size(); ++lambda) {
      const GgxLobe lobe = grid.lobe({alpha, lambda, 0, 0});
      result.push_back(
          first.try_emplace({lobe.alpha_x, lobe.alpha_y}, result.size()).first->second);
    }
  return result;
}

}  // namespace

std::vector<PlannedEntry> plan_by_symmetry(const Grid& grid) {
  return plan_by_symmetry(grid, std::vector<bool>(grid.size(), true));
}

std::vector<PlannedEntry> plan_by_symmetry(const Grid& grid, const std::vector<bool>& needed) {
  const std::vector<std::size_t> roughness = first_of_roughness(grid);
  const std::size_t views = grid.theta.size() * grid.phi.size();
  // By the first node of the same roughnesses and, where the azimuth matters, of the same view.
  std::vector<std::size_t> first_of_kind(grid.size(), PlannedEntry::none);
  std::vector<PlannedEntry> plan(grid.size());
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    if (!needed[flat])
      continue;
    const NodeIndex node = grid.node(flat);
    const GgxLobe lobe = grid.lobe(node);
    const bool isotropic = lobe.alpha_x == lobe.alpha_y;
    const bool upward = looks_upward(lobe.theta_radians);
    const std::size_t kind = roughness[flat / views] * views + node.theta * grid.phi.size() +
                             (isotropic || upward ? 0 : node.phi);
    std::size_t& representative = first_of_kind[kind];
    if (representative == PlannedEntry::none)
      representative = flat;
    plan[flat].representative = representative;
    if (isotropic && !upward)
      plan[flat].turn_radians = lobe.phi_radians - grid.lobe(grid.node(representative)).phi_radians;
  }
  return plan;
}

std::vector<std::size_t> each_lobe_once(const Grid& grid, const std::vector<std::size_t>& entries) {
  const std::vector<PlannedEntry> plan = plan_by_symmetry(grid);
  std::set<std::size_t> seen;
  std::vector<std::size_t> result;
  for (const std::size_t flat : entries)
    if (seen.insert(plan[flat].representative).second)
      result.push_back(flat);
  return result;
}

Eigen::Matrix3d turned(const Eigen::Matrix3d& matrix, double radians) {
  if (radians == 0)
    return matrix;
  const double c = std::cos(radians), s = std::sin(radians);
  Eigen::Matrix3d rotation;
  rotation << c, -s, 0, s, c, 0, 0, 0, 1;
  return rotation * matrix * rotation.transpose();
}

}  // namespace ltc
