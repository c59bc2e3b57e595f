// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The hot loops of the refinement's conjugate gradients, in single precision, for whatever vector
// unit the CPU has: a step is solved for to a hundredth.
//
// A node's numbers, nine or eleven, are padded to `lanes`. A curvature has so many columns, one
// after the other.
#pragma once

#include <cstddef>

namespace ltc::kernels {

inline constexpr std::size_t query_lanes = 16;
inline constexpr std::size_t cell_corners = 16;

// Neighbouring queries, their weights of the cell's corners and their curvatures, one after the
// other; the curvature of query q begins at curvatures + q * curvature_stride.
struct CellQueries {
  const float* curvatures;
  std::size_t curvature_stride;
  const float* weights;  // cell_corners of each
  std::size_t count;
  std::size_t numbers;  // of a node
};

// With s_j the corners' steps and w_pj the weights, sum_p w_pi H_p sum_j w_pj s_j of every corner
// i.
void multiply_cell(const CellQueries& queries, const float* steps, float* products);

// Adds weight * weight * H_p of the queries at one corner to `block`, numbers * query_lanes.
void add_blocks(const CellQueries& queries, std::size_t corner, float* block);

}  // namespace ltc::kernels
