// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Which entries of a grid are fitted, and which follow from another by symmetry.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "table/grid.h"

namespace ltc {

// An entry is the lobe of `representative` turned about the normal by `turn_radians`. It is its own
// representative, unturned, where it has to be fitted; it has none where nobody needs it.
struct PlannedEntry {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t representative = none;
  double turn_radians = 0;
};

// One planned entry a node. Equal lobes, and no others, share a representative, the first of them
// in the grid's order: at theta = 0 those of all phi; at alpha_x = alpha_y (lambda = 1, and
// wherever alpha_min raises both) those of all phi, turned; where alpha_min raises alpha_y those of
// all the lambda that it raises.
std::vector<PlannedEntry> plan_by_symmetry(const Grid& grid);

// The same over the entries that are needed, one flag a node: a representative is the first needed
// entry of its lobe, the others have none.
std::vector<PlannedEntry> plan_by_symmetry(const Grid& grid, const std::vector<bool>& needed);

// Of entries in any order, those that no earlier one has the lobe of, turned or not.
std::vector<std::size_t> each_lobe_once(const Grid& grid, const std::vector<std::size_t>& entries);

// R M R^-1 with R the rotation about z: the matrix of the lobe turned by `radians`.
Eigen::Matrix3d turned(const Eigen::Matrix3d& matrix, double radians);

}  // namespace ltc
