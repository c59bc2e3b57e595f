// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Refinement of a table as a whole: less error between the nodes, where a renderer looks.
//
// A node's own best matrix is not the best one to interpolate: between two nodes the mean of two
// good matrices fits neither lobe. This stage minimises the expected relative loss of the
// interpolated matrix,
//     F(S) = sum_p c_p loss_p(sum_i w_pi S_i) / spread_p,
// over the matrices S_i of all nodes at once (docs/refinement.md). Every outer step takes the
// quadratic model of F (query_system.h) and solves the damped normal equations
//     Pi (H + mu D) Pi s = -Pi grad F
// by conjugate gradients, with H the Gauss-Newton curvature, D its diagonal, Pi the projection on
// the steps that keep symmetry (node_space.h), preconditioned by the damped 9 x 9 blocks of H. The
// reweighted curvature majorises that of the loss, so that its steps are short and are lengthened.
// A step that does not lower F is taken back and mu raised. Queries that are not refined on decide
// which iterate is the best, and whether the refinement is worth keeping.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/run_context.h"
#include "refine/node_space.h"
#include "refine/refine_queries.h"

namespace ltc {

struct RefineReport {
  std::size_t queries = 0;  // refined on, nodes included
  double loss_before = 0;   // mean relative loss of the held-out queries
  double loss_after = 0;
  int steps = 0;      // outer steps, taken back or not
  bool kept = false;  // false: the table is as it came
  // Kept, and the last step gained little: another start would end alike.
  bool converged = false;
};

// Refines `stored`, one S a node of the grid with third column of unit length and positive
// determinant. Queries are drawn from `asked` in turn, at least one range; those beyond the axes
// and those that need a node without values are left out. Nodes that are not `movable` stay as they
// are. Throws Interrupted when a stop is asked for. The same bits for any number of threads.
// Node: Eigen::Matrix3d, or FoldedNode of a folded table (node_space.h).
template <typename Node>
RefineReport refine(const TableNodes& nodes, const std::vector<bool>& movable,
                    const std::vector<QueryRange>& asked, const RefineSettings& settings,
                    const RunContext& run, std::vector<Node>& stored);

// What refine() takes of memory, about.
std::size_t refinement_memory_bytes(const Grid& grid, Storage storage,
                                    const std::vector<bool>& has_values,
                                    const RefineSettings& settings);

// The sliced-Wasserstein loss of every node's own lobe at `stored` (fit/loss_meter.h); NaN where a
// node has no values. Throws Interrupted.
template <typename Node>
std::vector<double> node_losses(const TableNodes& nodes, const std::vector<Node>& stored,
                                const RunContext& run);

}  // namespace ltc
