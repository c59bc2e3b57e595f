// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the invariants measure in one matrix; no table, no limits.
#pragma once

#include <Eigen/Core>

namespace ltc {

// Largest singular value over smallest, infinite for a singular matrix, NaN in, NaN out; by the
// singular value decomposition of M itself, since that of M^T M would square it and lose what is
// looked for.
double condition_number(const Eigen::Matrix3d& matrix);

// Degrees by which align() turns M about z, in [0, 180]; a matrix of negative determinant counts as
// 180, being a reflection away. M must have an inverse.
double misalignment_degrees(const Eigen::Matrix3d& matrix);

}  // namespace ltc
