// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Which entries of a grid are fitted, and which follow from another by symmetry.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/run_context.h"
#include "table/grid.h"

namespace ltc {

// An entry is the lobe of `representative` turned about the normal by `turn_radians`. It is its own
// representative, unturned, where it has to be fitted; it has none where nobody needs it.
struct PlannedEntry {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t representative = none;
  double turn_radians = 0;
};

// Which nodes of a grid have equal lobes, told by their positions alone: no list of nodes is made.
class EqualLobes {
 public:
  explicit EqualLobes(const Grid& grid);

  // The first in the grid's order of those that are equal to the node's, turned or not.
  std::size_t first_of(std::size_t flat) const;
  std::size_t count() const;  // of lobes that differ
  // The pairs of alpha and lambda with equal roughnesses, in the grid's order.
  const std::vector<std::vector<std::size_t>>& pairs() const { return pairs_; }

 private:
  std::size_t phis_;
  std::vector<bool> upward_;        // by theta
  std::vector<bool> isotropic_;     // by pair of alpha and lambda, in the grid's order
  std::vector<std::size_t> first_;  // the first pair with the same roughnesses, likewise
  std::vector<std::vector<std::size_t>> pairs_;
};

// One planned entry a node. Equal lobes, and no others, share a representative, the first of them
// in the grid's order: at theta = 0 those of all phi; at alpha_x = alpha_y (lambda = 1, and
// wherever alpha_min raises both) those of all phi, turned; where alpha_min raises alpha_y those of
// all the lambda that it raises.
std::vector<PlannedEntry> plan_by_symmetry(const Grid& grid);

// The same over the entries that are needed, one flag a node: a representative is the first needed
// entry of its lobe, the others have none. Throws Interrupted when `run` asks for a stop.
std::vector<PlannedEntry> plan_by_symmetry(const Grid& grid, const std::vector<bool>& needed,
                                           const RunContext& run = {});

// How many entries are to be fitted.
std::size_t representative_count(const std::vector<PlannedEntry>& plan);

// Of entries in any order, those that no earlier one has the lobe of, turned or not.
std::vector<std::size_t> each_lobe_once(const Grid& grid, const std::vector<std::size_t>& entries);

// R M R^-1 with R the rotation about z: the matrix of the lobe turned by `radians`.
Eigen::Matrix3d turned(const Eigen::Matrix3d& matrix, double radians);

}  // namespace ltc
