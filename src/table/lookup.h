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

// The 16 nodes (flat indices) about a folded lobe and their multilinear weights, which sum to 1. A
// lobe outside the axes is clamped to them.
struct Interpolation {
  std::array<std::size_t, 16> nodes;
  std::array<double, 16> weights;
};
Interpolation interpolation(const Grid& grid, const GgxLobe& folded);

// What a shader has after the fetch. NaN where a needed node is skipped or failed.
struct LookUp {
  Eigen::Matrix3d matrix;
  double amplitude;
  double fresnel;
};
LookUp look_up(const Table& table, const GgxLobe& lobe);

}  // namespace ltc
