// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/symmetry_plan.h"

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "table/symmetry.h"

namespace ltc {

std::vector<PlannedEntry> plan_by_symmetry(const Grid& grid) {
  return plan_by_symmetry(grid, std::vector<bool>(grid.size(), true));
}

std::vector<PlannedEntry> plan_by_symmetry(const Grid& grid, const std::vector<bool>& needed) {
  using Key = std::tuple<double, double, double, double>;
  std::map<Key, std::size_t> first_of_kind;
  std::vector<PlannedEntry> plan(grid.size());
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    if (!needed[flat])
      continue;
    const GgxLobe lobe = grid.lobe(grid.node(flat));
    const bool isotropic = lobe.alpha_x == lobe.alpha_y;
    const bool upward = looks_upward(lobe.theta_radians);
    const bool any_azimuth = isotropic || upward;
    const Key key{lobe.alpha_x, lobe.alpha_y, lobe.theta_radians,
                  any_azimuth ? 0.0 : lobe.phi_radians};
    const std::size_t representative = first_of_kind.try_emplace(key, flat).first->second;
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
