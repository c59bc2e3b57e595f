// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The products that a field's normal equations are made of and solved by, for whatever vector unit
// the CPU has.
#pragma once

#include <cstddef>

namespace ltc::kernels {

// Columns of `rows` numbers, each `pitch` after the one before.
template <typename Number>
struct ColumnsOf {
  const Number* data;
  std::size_t rows, count;
  std::size_t pitch = rows;
};
using Columns = ColumnsOf<float>;

// Rows that are summed in the numbers' own precision.
inline constexpr std::size_t product_stretch = 256;

// result(i, j) = sum_q a(q, i) b(q, j), a column of `stride` for each j: over
// stretches of rows in their precision, and in double from stretch to stretch. The same number of
// rows in both.
void multiply_transposed(const Columns& a, const Columns& b, double* result, std::size_t stride);
void multiply_transposed(const ColumnsOf<double>& a, const ColumnsOf<double>& b, double* result,
                         std::size_t stride);

// result(i, j) = sum_q a(q, i) weights_q b(q, j).
void multiply_weighted(const Columns& a, const float* weights, const Columns& b, double* result,
                       std::size_t stride);

}  // namespace ltc::kernels
