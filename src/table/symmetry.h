// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Which entries of a table's matrices are zero by the symmetry of GGX: equation (16) of Aakash et
// al. 2022. They are so for the stored S of every storage as they are for M.
#pragma once

#include <Eigen/Core>

namespace ltc {

// A node within this many radians of theta = 0, phi = 0 or phi = pi/2 has that view's symmetry.
inline constexpr double symmetry_tolerance = 1e-9;

// Which views have which symmetry.
bool looks_upward(double theta_radians);                       // theta = 0
bool looks_along_x(double theta_radians, double phi_radians);  // in the plane y = 0
bool looks_along_y(double theta_radians, double phi_radians);  // in the plane x = 0

// True where equation (16) wants a zero in the matrix of a view. An upward view has both
// symmetries, which leave the diagonal.
Eigen::Matrix<bool, 3, 3> symmetry_zeros(double theta_radians, double phi_radians);

}  // namespace ltc
