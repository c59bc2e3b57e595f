// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/query_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/query_kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
// After foreach_target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ltc::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, query_lanes>;
using V = hn::Vec<Floats>;

void MultiplyCell(const CellQueries& queries, const float* steps, float* products) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < cell_corners * query_lanes; i += lanes)
    hn::Store(hn::Zero(d), d, products + i);
  HWY_ALIGN float interpolated[query_lanes];
  for (std::size_t q = 0; q < queries.count; ++q) {
    const float* weights = queries.weights + q * cell_corners;
    const float* curvature = queries.curvatures + q * queries.curvature_stride;
    for (std::size_t part = 0; part < query_lanes; part += lanes) {
      V even = hn::Zero(d), odd = hn::Zero(d);
      for (std::size_t corner = 0; corner < cell_corners; corner += 2) {
        const float* step = steps + corner * query_lanes + part;
        even = hn::MulAdd(hn::Set(d, weights[corner]), hn::Load(d, step), even);
        odd = hn::MulAdd(hn::Set(d, weights[corner + 1]), hn::Load(d, step + query_lanes), odd);
      }
      hn::Store(hn::Add(even, odd), d, interpolated + part);
    }
    for (std::size_t part = 0; part < query_lanes; part += lanes) {
      V pulled = hn::Zero(d);
      for (std::size_t column = 0; column < queries.numbers; ++column)
        pulled = hn::MulAdd(hn::Set(d, interpolated[column]),
                            hn::Load(d, curvature + column * query_lanes + part), pulled);
      for (std::size_t corner = 0; corner < cell_corners; ++corner) {
        float* product = products + corner * query_lanes + part;
        hn::Store(hn::MulAdd(hn::Set(d, weights[corner]), pulled, hn::Load(d, product)), d,
                  product);
      }
    }
  }
}

void AddBlocks(const CellQueries& queries, std::size_t corner, float* block) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d), size = queries.numbers * query_lanes;
  for (std::size_t q = 0; q < queries.count; ++q) {
    const float weight = queries.weights[q * cell_corners + corner];
    if (weight == 0)
      continue;
    const V squared = hn::Set(d, weight * weight);
    const float* curvature = queries.curvatures + q * queries.curvature_stride;
    for (std::size_t i = 0; i < size; i += lanes)
      hn::Store(hn::MulAdd(squared, hn::Load(d, curvature + i), hn::Load(d, block + i)), d,
                block + i);
  }
}

}  // namespace ltc::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ltc::kernels {

HWY_EXPORT(MultiplyCell);
HWY_EXPORT(AddBlocks);

void multiply_cell(const CellQueries& queries, const float* steps, float* products) {
  HWY_DYNAMIC_DISPATCH(MultiplyCell)(queries, steps, products);
}

void add_blocks(const CellQueries& queries, std::size_t corner, float* block) {
  HWY_DYNAMIC_DISPATCH(AddBlocks)(queries, corner, block);
}

}  // namespace ltc::kernels
#endif
