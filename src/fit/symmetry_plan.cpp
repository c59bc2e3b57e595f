// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/symmetry_plan.h"

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/parallel.h"
#include "table/symmetry.h"

namespace ltc {

EqualLobes::EqualLobes(const Grid& grid) : phis_(grid.phi.size()) {
  for (const double theta_radians : grid.theta.nodes)
    upward_.push_back(looks_upward(theta_radians));
  std::map<std::pair<double, double>, std::size_t> group_of;
  for (std::size_t alpha = 0; alpha < grid.alpha.size(); ++alpha)
    for (std::size_t lambda = 0; lambda < grid.lambda.size(); ++lambda) {
      const Lobe lobe = grid.lobe({alpha, lambda, 0, 0});
      isotropic_.push_back(lobe.alpha_x == lobe.alpha_y);
      const auto [found, is_new] =
          group_of.try_emplace({lobe.alpha_x, lobe.alpha_y}, pairs_.size());
      if (is_new)
        pairs_.emplace_back();
      std::vector<std::size_t>& group = pairs_[found->second];
      group.push_back(first_.size());
      first_.push_back(group.front());
    }
}

std::size_t EqualLobes::first_of(std::size_t flat) const {
  const std::size_t phi = flat % phis_, view = flat / phis_;
  const std::size_t theta = view % upward_.size(), pair = view / upward_.size();
  const bool all_phi = isotropic_[pair] || upward_[theta];
  return (first_[pair] * upward_.size() + theta) * phis_ + (all_phi ? 0 : phi);
}

std::size_t EqualLobes::count() const {
  std::size_t result = 0;
  for (const std::vector<std::size_t>& group : pairs_)
    for (const bool upward : upward_)
      result += isotropic_[group.front()] || upward ? 1 : phis_;
  return result;
}

std::vector<PlannedEntry> plan_by_symmetry(const Grid& grid) {
  return plan_by_symmetry(grid, std::vector<bool>(grid.size(), true));
}

std::vector<PlannedEntry> plan_by_symmetry(const Grid& grid, const std::vector<bool>& needed,
                                           const RunContext& run) {
  const EqualLobes equal(grid);
  const std::size_t phis = grid.phi.size(), views = grid.theta.size() * phis;
  std::vector<PlannedEntry> plan(grid.size());
  parallel_for(equal.pairs().size(), run, [&](std::size_t group) {
    // The first of a lobe's nodes, needed or not, knows the first that is until all are planned.
    const std::vector<std::size_t>& pairs = equal.pairs()[group];
    for (const std::size_t pair : pairs)
      for (std::size_t flat = pair * views; flat < (pair + 1) * views; ++flat) {
        if (!needed[flat])
          continue;
        std::size_t& representative = plan[equal.first_of(flat)].representative;
        if (representative == PlannedEntry::none)
          representative = flat;
        plan[flat].representative = representative;
        if (!looks_upward(grid.theta.nodes[flat / phis % grid.theta.size()]))
          plan[flat].turn_radians =
              grid.phi.nodes[flat % phis] - grid.phi.nodes[representative % phis];
      }
    for (std::size_t flat = pairs.front() * views; flat < (pairs.front() + 1) * views; ++flat)
      if (!needed[flat])
        plan[flat].representative = PlannedEntry::none;
  });
  return plan;
}

std::size_t representative_count(const std::vector<PlannedEntry>& plan) {
  std::size_t count = 0;
  for (std::size_t flat = 0; flat < plan.size(); ++flat)
    count += plan[flat].representative == flat;
  return count;
}

std::vector<std::size_t> each_lobe_once(const Grid& grid, const std::vector<std::size_t>& entries) {
  const EqualLobes equal(grid);
  std::set<std::size_t> seen;
  std::vector<std::size_t> result;
  for (const std::size_t flat : entries)
    if (seen.insert(equal.first_of(flat)).second)
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
