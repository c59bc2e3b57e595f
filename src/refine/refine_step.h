// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// One step of the refinement: the damped normal equations of all nodes, by conjugate gradients.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "refine/node_space.h"
#include "refine/query_system.h"

namespace ltc {

// Solves Pi (H + damping D) Pi s = -Pi grad F of the model that `queries` has in use (refine.h) and
// returns s times `overshoot`. Throws Interrupted when a stop is asked for. The same bits for any
// number of threads.
template <typename Node>
NodeVectorsOf<Node> refinement_step(const QuerySystemOf<Node>& queries, const NodeSpace& space,
                                    const std::vector<Node>& stored, double damping,
                                    double overshoot, const RunContext& run = {});

}  // namespace ltc
