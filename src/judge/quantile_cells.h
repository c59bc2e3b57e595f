// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A weighted point set on a line, laid out so that its distance to many equally weighted ones is
// one pass over two arrays.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/aligned.h"
#include "core/ordered_float.h"

namespace ltc {

// The quantile function G^-1 of n weighted values, cut into n cells of equal mass. Against n sorted
// values x of equal weight, the distance in one dimension is
//     W = int_0^1 |F^-1 - G^-1| du = sum_i int_(cell i) |x_i - G^-1| du.
// Where x_i does not fall among the values of its cell, the integral is |x_i - the cell's mean| /
// n: exact, and nothing but a subtraction. Only the few other cells are walked value by value.
class QuantileCells {
 public:
  // A value and its weight, which must not be negative, as one key that sorts by the value.
  static std::uint64_t key(float value, float weight) {
    return sort_key(value, std::bit_cast<std::uint32_t>(weight));
  }

  // `keys` in ascending order, a multiple of 16 of them. `total` is the sum of their weights,
  // `largest` the largest one.
  void build(const AlignedVector<std::uint64_t>& keys, double total, float largest);

  // W above of `count` values, aligned; of as many as there are cells as said, of other numbers
  // exactly too, value by value.
  double distance(const float* sorted, std::size_t count);

  // int_0^1 |G^-1(u) - G^-1(1/2)| du: the mean absolute deviation from the median.
  double spread() const { return spread_; }

 private:
  double walk(std::size_t cell, float x) const;

  AlignedFloats values_;                  // ascending
  AlignedVector<double> masses_;          // cumulative, of all values before each, in cells
  AlignedVector<std::uint32_t> first_;    // the value that each cell begins with
  AlignedFloats bounds_, means_;          // G^-1 at each cell's beginning and end; its mean
  AlignedVector<double> moments_;         // scratch: int of G^-1 over all values before each
  AlignedVector<std::uint32_t> to_walk_;  // scratch
  double spread_ = 0;
};

// W of two sets of equally weighted values, aligned and in ascending order.
double sorted_distance(const float* x, std::size_t x_count, const float* y, std::size_t y_count);

}  // namespace ltc
