// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/field_kernels.h"

#include <algorithm>

#include "core/aligned.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/field_kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
// After foreach_target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ltc::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
// The lanes of the widest vectors.
template <typename Number>
constexpr std::size_t most_lanes = 64 / sizeof(Number);

// So many columns of a and b at once keep all sums in registers, and stretches of so many tiles of
// them the nearest cache.
constexpr std::size_t height = 4, width = 3, stretch = product_stretch, tiles = 4;

// The products of height columns of a and width of b over a stretch; columns beyond the last one
// are the last one again.
template <typename Number>
void multiply_tile(const ColumnsOf<Number>& a, std::size_t i, const ColumnsOf<Number>& b,
                   std::size_t j, Number (&products)[width][height]) {
  constexpr std::size_t most = most_lanes<Number>;
  const hn::CappedTag<Number, most> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t whole = a.rows / most * most;
  const Number* of_a[height];
  const Number* of_b[width];
  for (std::size_t k = 0; k < height; ++k)
    of_a[k] = a.data + std::min(i + k, a.count - 1) * a.pitch;
  for (std::size_t k = 0; k < width; ++k)
    of_b[k] = b.data + std::min(j + k, b.count - 1) * b.pitch;
  // Lane by lane of the widest vectors, so that every vector unit finds the same bits.
  HWY_ALIGN Number rows[width][height][most];
  for (std::size_t part = 0; part < most; part += hn::Lanes(d)) {
    V s00 = hn::Zero(d), s01 = s00, s02 = s00, s10 = s00, s11 = s00, s12 = s00;
    V s20 = s00, s21 = s00, s22 = s00, s30 = s00, s31 = s00, s32 = s00;
    for (std::size_t q = part; q < whole; q += most) {
      const V b0 = hn::LoadU(d, of_b[0] + q), b1 = hn::LoadU(d, of_b[1] + q),
              b2 = hn::LoadU(d, of_b[2] + q);
      V value = hn::LoadU(d, of_a[0] + q);
      s00 = hn::MulAdd(value, b0, s00);
      s01 = hn::MulAdd(value, b1, s01);
      s02 = hn::MulAdd(value, b2, s02);
      value = hn::LoadU(d, of_a[1] + q);
      s10 = hn::MulAdd(value, b0, s10);
      s11 = hn::MulAdd(value, b1, s11);
      s12 = hn::MulAdd(value, b2, s12);
      value = hn::LoadU(d, of_a[2] + q);
      s20 = hn::MulAdd(value, b0, s20);
      s21 = hn::MulAdd(value, b1, s21);
      s22 = hn::MulAdd(value, b2, s22);
      value = hn::LoadU(d, of_a[3] + q);
      s30 = hn::MulAdd(value, b0, s30);
      s31 = hn::MulAdd(value, b1, s31);
      s32 = hn::MulAdd(value, b2, s32);
    }
    const V sums[width][height] = {
        {s00, s10, s20, s30}, {s01, s11, s21, s31}, {s02, s12, s22, s32}};
    for (std::size_t column = 0; column < width; ++column)
      for (std::size_t row = 0; row < height; ++row)
        hn::Store(sums[column][row], d, rows[column][row] + part);
  }
  for (std::size_t column = 0; column < width; ++column)
    for (std::size_t row = 0; row < height; ++row) {
      Number sum = 0;
      for (const Number lane : rows[column][row])
        sum += lane;
      for (std::size_t q = whole; q < a.rows; ++q)
        sum += of_a[row][q] * of_b[column][q];
      products[column][row] = sum;
    }
}

// Adds the products over a stretch.
template <typename Number>
void add_products(const ColumnsOf<Number>& a, const ColumnsOf<Number>& b, double* result,
                  std::size_t stride) {
  constexpr std::size_t block_height = tiles * height, block_width = tiles * width;
  for (std::size_t left = 0; left < b.count; left += block_width)
    for (std::size_t top = 0; top < a.count; top += block_height)
      for (std::size_t j = left; j < std::min(left + block_width, b.count); j += width)
        for (std::size_t i = top; i < std::min(top + block_height, a.count); i += height) {
          Number products[width][height];
          multiply_tile(a, i, b, j, products);
          for (std::size_t column = 0; column < width && j + column < b.count; ++column)
            for (std::size_t row = 0; row < height && i + row < a.count; ++row)
              result[(j + column) * stride + i + row] += static_cast<double>(products[column][row]);
        }
}

// `weights` may be null; `weighted`, of a stretch for each column of b, is where b times them
// stands then: nearer than all of it would.
template <typename Number>
void multiply(const ColumnsOf<Number>& a, const Number* weights, const ColumnsOf<Number>& b,
              Number* weighted, double* result, std::size_t stride) {
  for (std::size_t j = 0; j < b.count; ++j)
    std::fill_n(result + j * stride, a.count, 0.0);
  for (std::size_t begin = 0; begin < a.rows; begin += stretch) {
    const std::size_t rows = std::min(stretch, a.rows - begin);
    const ColumnsOf<Number> of_a{a.data + begin, rows, a.count, a.pitch};
    ColumnsOf<Number> of_b{b.data + begin, rows, b.count, b.pitch};
    if (weights) {
      for (std::size_t j = 0; j < b.count; ++j)
        for (std::size_t q = 0; q < rows; ++q)
          weighted[j * stretch + q] = weights[begin + q] * of_b.data[j * b.pitch + q];
      of_b = {weighted, rows, b.count, stretch};
    }
    add_products(of_a, of_b, result, stride);
  }
}

void MultiplyFloats(const Columns& a, const float* weights, const Columns& b, float* weighted,
                    double* result, std::size_t stride) {
  multiply(a, weights, b, weighted, result, stride);
}
void MultiplyDoubles(const ColumnsOf<double>& a, const ColumnsOf<double>& b, double* result,
                     std::size_t stride) {
  multiply<double>(a, nullptr, b, nullptr, result, stride);
}

}  // namespace ltc::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ltc::kernels {

HWY_EXPORT(MultiplyFloats);
HWY_EXPORT(MultiplyDoubles);

void multiply_transposed(const Columns& a, const Columns& b, double* result, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(MultiplyFloats)(a, nullptr, b, nullptr, result, stride);
}
void multiply_transposed(const ColumnsOf<double>& a, const ColumnsOf<double>& b, double* result,
                         std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(MultiplyDoubles)(a, b, result, stride);
}

void multiply_weighted(const Columns& a, const float* weights, const Columns& b, double* result,
                       std::size_t stride) {
  AlignedFloats weighted(product_stretch * b.count);
  HWY_DYNAMIC_DISPATCH(MultiplyFloats)(a, weights, b, weighted.data(), result, stride);
}

}  // namespace ltc::kernels
#endif
