// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The loops of exact one-dimensional distances, for whatever vector unit the CPU has.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/points.h"

namespace ltc::kernels {

// All arrays are aligned (core/aligned.h) and `count` is a multiple of 16.

// sum |x_i - mean_i| over those i for which x_i is not between bound_i and bound_(i+1); the others
// are written to `inside`, which has room for `count` of them and 16 more, and `inside_count` says
// how many they are. `bound` has count + 1 values.
double sum_outside(const float* x, const float* mean, const float* bound, std::size_t count,
                   std::uint32_t* inside, std::size_t& inside_count);

// sum |x_i - y_i|.
double sum_differences(const float* x, const float* y, std::size_t count);

// The points along a direction (x, y, z), every operation rounded on its own.
void project(const float* direction, const Points& points, float* projections);

}  // namespace ltc::kernels
