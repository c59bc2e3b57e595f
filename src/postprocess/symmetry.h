// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Enforces the zeros that symmetry demands of a table's matrices: equation (16) of Aakash et al.
// 2022. At theta = 0 the matrix is also the same for every phi: whoever fills a table fits one and
// copies it.
#pragma once

#include <Eigen/Core>

#include "table/symmetry.h"

namespace ltc {

// Sets the zeros of equation (16). Returns the largest absolute value that it set to zero, 0 where
// there was nothing to set; NaN if one of them was.
double enforce_symmetry(double theta_radians, double phi_radians, Eigen::Matrix3d& matrix);

}  // namespace ltc
