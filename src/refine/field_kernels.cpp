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

// A tile has two vectors of numbers of a by so many of b, whose sums keep in registers: of these
// there are 32 where vectors have 64 bytes, and 16 elsewhere. Every sum goes row by row, so that
// tiles of any shape make the same bits.
constexpr std::size_t width = HWY_MAX_BYTES >= 64 ? 12 : 6;
constexpr std::size_t stretch = product_stretch;

template <typename Number>
using Tag = hn::CappedTag<Number, 64 / sizeof(Number)>;
template <typename Number>
std::size_t height() {
  return 2 * hn::Lanes(Tag<Number>());
}

// The place that so many numbers take in whole vectors.
template <typename Number>
std::size_t padded(std::size_t size) {
  const std::size_t lanes = hn::Lanes(Tag<Number>());
  return (size + lanes - 1) / lanes * lanes;
}

// Panels of `size` numbers of every row as tiles read them, panel after panel and in each row after
// row, padded; zeros beyond the last. Row by row, for rows lie far apart.
template <typename Number>
void pack(const RowsOf<Number>& from, const Number* weights, std::size_t size, Number* packed) {
  const Tag<Number> d;
  const std::size_t place = padded<Number>(size), panel = from.depth * place;
  for (std::size_t q = 0; q < from.depth; ++q) {
    const Number* row = from.data + q * from.pitch;
    const Number weight = weights ? weights[q] : Number{1};
    std::size_t first = 0;
    Number* to = packed + q * place;
    for (; first + place <= from.count; first += size, to += panel)
      for (std::size_t i = 0; i < place; i += hn::Lanes(d))
        hn::Store(hn::Mul(hn::Set(d, weight), hn::LoadU(d, row + first + i)), d, to + i);
    for (; first < from.count; first += size, to += panel)
      for (std::size_t i = 0; i < size; ++i)
        to[i] = first + i < from.count ? weight * row[first + i] : Number{0};
  }
}

// The products of a tile, of rows as they are packed; products[j] has those with b's j-th number.
template <typename Number>
void multiply_tile(const Number* a, const Number* b, std::size_t depth, Number* products) {
  const Tag<Number> d;
  using V = hn::Vec<Tag<Number>>;
  const std::size_t lanes = hn::Lanes(d), place = padded<Number>(width);
  // All loops over them unrolled: else they live in memory.
  V first[width], second[width];
#pragma GCC unroll 12
  for (std::size_t j = 0; j < width; ++j)
    first[j] = second[j] = hn::Zero(d);
  for (std::size_t q = 0; q < depth; ++q, a += 2 * lanes, b += place) {
    const V a0 = hn::Load(d, a), a1 = hn::Load(d, a + lanes);
#pragma GCC unroll 12
    for (std::size_t j = 0; j < width; ++j) {
      const V of_b = hn::Set(d, b[j]);
      first[j] = hn::MulAdd(a0, of_b, first[j]);
      second[j] = hn::MulAdd(a1, of_b, second[j]);
    }
  }
#pragma GCC unroll 12
  for (std::size_t j = 0; j < width; ++j, products += 2 * lanes) {
    hn::Store(first[j], d, products);
    hn::Store(second[j], d, products + lanes);
  }
}

template <typename Number>
void AddProducts(const RowsOf<Number>& a, const Number* weights, const RowsOf<Number>& b,
                 double scale, double* result, std::size_t stride, Products wanted) {
  constexpr const Number* none = nullptr;
  const std::size_t tall = height<Number>(), wide = padded<Number>(width);
  const auto panels = [](std::size_t count, std::size_t size) { return (count + size - 1) / size; };
  // Kept, for there are thousands of calls.
  static thread_local AlignedVector<Number> of_a, of_b;
  const auto grow = [](AlignedVector<Number>& buffer, std::size_t size) {
    if (buffer.size() < size)
      buffer.resize(size);
  };
  grow(of_a, panels(a.count, tall) * tall * stretch);
  grow(of_b, panels(b.count, width) * wide * stretch);
  HWY_ALIGN Number products[2 * (64 / sizeof(Number)) * width];
  for (std::size_t begin = 0; begin < a.depth; begin += stretch) {
    const std::size_t depth = std::min(stretch, a.depth - begin);
    const RowsOf<Number> some_a{a.data + begin * a.pitch, a.count, depth, a.pitch};
    const RowsOf<Number> some_b{b.data + begin * b.pitch, b.count, depth, b.pitch};
    pack(some_a, weights ? weights + begin : none, tall, of_a.data());
    pack(some_b, none, width, of_b.data());
    for (std::size_t i = 0; i < a.count; i += tall) {
      const std::size_t rows = std::min(tall, a.count - i);
      for (std::size_t j = 0; j < b.count; j += width) {
        if (wanted == Products::upper && i >= j + width)
          continue;
        multiply_tile(of_a.data() + i * depth, of_b.data() + j / width * wide * depth, depth,
                      products);
        for (std::size_t column = 0; column < std::min(width, b.count - j); ++column) {
          double* sums = result + (j + column) * stride + i;
          for (std::size_t row = 0; row < rows; ++row)
            sums[row] += scale * static_cast<double>(products[column * tall + row]);
        }
      }
    }
  }
}

void AddFloats(const RowsOf<float>& a, const float* weights, const RowsOf<float>& b, double scale,
               double* result, std::size_t stride, Products wanted) {
  AddProducts(a, weights, b, scale, result, stride, wanted);
}
void AddDoubles(const RowsOf<double>& a, const double* weights, const RowsOf<double>& b,
                double scale, double* result, std::size_t stride, Products wanted) {
  AddProducts(a, weights, b, scale, result, stride, wanted);
}

}  // namespace ltc::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ltc::kernels {

HWY_EXPORT(AddFloats);
HWY_EXPORT(AddDoubles);

void add_products(const RowsOf<float>& a, const float* weights, const RowsOf<float>& b,
                  double scale, double* result, std::size_t stride, Products wanted) {
  HWY_DYNAMIC_DISPATCH(AddFloats)(a, weights, b, scale, result, stride, wanted);
}
void add_products(const RowsOf<double>& a, const double* weights, const RowsOf<double>& b,
                  double scale, double* result, std::size_t stride, Products wanted) {
  HWY_DYNAMIC_DISPATCH(AddDoubles)(a, weights, b, scale, result, stride, wanted);
}

}  // namespace ltc::kernels
#endif
