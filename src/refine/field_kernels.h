// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The product that a field's normal equations are made of, for whatever vector unit the CPU has.
#pragma once

#include <cstddef>

namespace ltc::kernels {

// Columns of `rows` numbers, one after the other.
struct Columns {
  const float* data;
  std::size_t rows, count;
};

// result(i, j) = sum_q a(q, i) b(q, j), a column of `stride` for each j: in single precision over
// stretches of rows, and in double from stretch to stretch. The same number of rows in both.
void multiply_transposed(const Columns& a, const Columns& b, double* result, std::size_t stride);

}  // namespace ltc::kernels
