// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Where a fit starts from. One start is not enough: see GaussNewtonSettings::starts.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "fit/lobe_frame.h"
#include "fit/quantile_model.h"
#include "fit/settings.h"

namespace ltc {

// All of these return the frame matrix P of lobe_frame.h with its symmetry zeros in place and a
// determinant > 0.

// P0, exact as the roughness goes to zero: reflecting about the microfacet normal is linear in the
// slopes to first order, and clamped-cosine slopes have the GGX slope distribution. The thinner
// axis is widened to a tenth of the other.
Eigen::Matrix3d first_order_start(const LobeFrame& frame);

// The LTC that has the lobe's mean direction as its axis and, along the principal axes of the
// lobe's covariance about it, the lobe's mean absolute deviations; the thinner one is widened to a
// tenth of the other.
Eigen::Matrix3d moment_start(const LobeFrame& frame, const TargetSamples& target);

// M = I, the clamped cosine itself.
Eigen::Matrix3d identity_start(const LobeFrame& frame);

// The moment start with every free entry moved by normal noise of 0.4 times its column's typical
// entry.
Eigen::Matrix3d random_start(const LobeFrame& frame, const TargetSamples& target,
                             std::uint64_t seed);

// The one of these that a config names.
Eigen::Matrix3d start_of_kind(StartKind kind, const LobeFrame& frame, const TargetSamples& target,
                              std::uint64_t seed);

// P with the entries that are not free set to zero and column 1 turned where the determinant was
// negative, which leaves the lobe as it is. The result may still be singular.
Eigen::Matrix3d admissible(const Eigen::Matrix3d& frame_matrix, const FreeEntries& free);

// P of a matrix M that may be anything, as near to M as a fit can start from: M at the scale of one
// and, for the sign of M moves only the lobe to the opposite side of the sphere, looking to the
// mirror direction's; then `admissible`. NaN for a matrix that is not finite or all zero; may be
// singular.
Eigen::Matrix3d repaired(const LobeFrame& frame, const Eigen::Matrix3d& matrix);

}  // namespace ltc
