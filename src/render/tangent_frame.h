// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The frame of a surface of revolution about the upright axis y.
#pragma once

#include <Eigen/Core>

namespace ltc {

// Rows along the parallel (east, which is level), along the meridian (north), and the unit normal.
// Where the normal is upright every direction is south, or north; east is world x.
Eigen::Matrix3d tangent_frame(const Eigen::Vector3d& normal);

}  // namespace ltc
