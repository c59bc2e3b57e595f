// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The look-up a shader does, in C++: reduction by symmetry and interpolation.
#pragma once

#include <Eigen/Core>
#include <array>

#include "table/reduction.h"
#include "table/table.h"

namespace ltc {

// The 16 nodes (flat indices) about a folded lobe and their multilinear weights, which sum to 1. A
// lobe outside the axes is clamped to them. The lobe stands at alpha = alpha_x and lambda =
// alpha_y / alpha_x as given, below alpha_min too (lambda = 1 where both are 0): ask for a node by
// the values of its axes, roughnesses alpha and lambda alpha, not by Grid::lobe's bounded ones. A
// corner that plays no part has weight 0 and may be any node. NaN in, NaN weights out. With
// Layout::alphax_alphay it stands at its alpha_x and alpha_y.
struct Interpolation {
  std::array<std::size_t, 16> nodes;
  std::array<double, 16> weights;
};
Interpolation interpolation(const Grid& grid, const Lobe& folded);

// What a shader has after the fetch. NaN where a needed node is skipped or failed, or the lobe is
// NaN. With a storage other than `matrix`, the roughnesses that scale S are at least alpha_min.
// Where `unfold` is a reflection (each sign of -1 and the swap count one), the determinant is
// negative: the lobe is right, but a polygon taken through the inverse changes its winding.
struct LookUp {
  Eigen::Matrix3d matrix;
  double amplitude;
  double fresnel;
  // Of folded lobes (ltc/folded.h).
  Fold fold = {};
  Creases creases = {};

  LtcLobe ltc() const { return {matrix, fold, creases}; }
};
LookUp look_up(const Table& table, const Lobe& lobe);

}  // namespace ltc
