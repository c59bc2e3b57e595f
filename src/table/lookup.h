// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The look-up a shader does, in C++: folding by symmetry and interpolation.
#pragma once

#include <Eigen/Core>
#include <array>

#include "table/table.h"

namespace ltc {

// A lobe folded into the table's domain, equations (13) to (15) of Aakash et al. 2022: the lobe
// asked for is `unfold` applied to the folded one, M = unfold * M_folded.
struct FoldedLobe {
  GgxLobe lobe;            // alpha_x >= alpha_y, phi in [0, pi/2]
  Eigen::Matrix3d unfold;  // diagonal of +-1, times the swap of x and y where alpha_y > alpha_x
};
FoldedLobe fold(const GgxLobe& lobe);

// The lobe as a table of this grid is asked for it: with Layout::alphax_alphay, which has both
// orders of the roughnesses, nothing is swapped, as that table's users do.
FoldedLobe fold(const Grid& grid, const GgxLobe& lobe);

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
Interpolation interpolation(const Grid& grid, const GgxLobe& folded);

// Whether a folded lobe is on the axes, or so little beyond them that clamping is no matter: the
// last node of the paper's theta is 1.6e-4 from the horizon.
bool covers(const Grid& grid, const GgxLobe& folded);

// What a shader has after the fetch. NaN where a needed node is skipped or failed, or the lobe is
// NaN. With a storage other than `matrix`, the roughnesses that scale S are at least alpha_min.
// Where `unfold` is a reflection (each sign of -1 and the swap count one), the determinant is
// negative: the lobe is right, but a polygon taken through the inverse changes its winding.
struct LookUp {
  Eigen::Matrix3d matrix;
  double amplitude;
  double fresnel;
};
LookUp look_up(const Table& table, const GgxLobe& lobe);

}  // namespace ltc
