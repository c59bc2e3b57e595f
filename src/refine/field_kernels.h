// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The products that a field's normal equations are made of and solved by, for whatever vector unit
// the CPU has.
#pragma once

#include <cstddef>

namespace ltc::kernels {

// `depth` rows of `count` numbers, each row `pitch` after the one before.
template <typename Number>
struct RowsOf {
  const Number* data;
  std::size_t count, depth;
  std::size_t pitch = count;
};

// Rows that are summed in the numbers' own precision.
inline constexpr std::size_t product_stretch = 256;

// Which of the products are wanted: all, or those with i <= j, where others may be added too.
enum class Products { all, upper };

// result(i, j) += scale sum_q a(q, i) weights_q b(q, j), a column of `stride` for each j; without
// weights where there are none. Over stretches of rows in the numbers' precision, one after the
// other, and in double from stretch to stretch. The same number of rows in both. Of single
// precision, weights and a are multiplied first.
void add_products(const RowsOf<float>& a, const float* weights, const RowsOf<float>& b,
                  double scale, double* result, std::size_t stride, Products wanted);
void add_products(const RowsOf<double>& a, const double* weights, const RowsOf<double>& b,
                  double scale, double* result, std::size_t stride, Products wanted);

}  // namespace ltc::kernels
