// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How many bits a stored value has, and what that leaves of a matrix.
#pragma once

#include <Eigen/Core>
#include <limits>

namespace ltc {

enum class Precision { single, half };  // 32 bits, 16 bits

inline float largest_value(Precision precision) {
  return precision == Precision::half ? 65504.0f : std::numeric_limits<float>::max();
}

// The nearest that the precision has, ties to even, as processors and texture units round; infinite
// where it is beyond the largest.
float rounded(float value, Precision precision);
// Every entry.
Eigen::Matrix3d rounded(const Eigen::Matrix3d& matrix, Precision precision);

}  // namespace ltc
