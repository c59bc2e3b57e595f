// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The loops, compiled once for every vector unit and chosen at run time.
#include "judge/quantile_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "judge/quantile_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ltc::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, 16>;
using Indices = hn::Rebind<std::uint32_t, Floats>;
using V = hn::Vec<Floats>;

// Lanes are carried over to double after so many samples, before single precision would tell.
constexpr std::size_t block = 512;

template <class Term>
double sum_of(std::size_t count, Term&& term) {
  const Floats d;
  double sum = 0;
  for (std::size_t begin = 0; begin < count; begin += block) {
    V lanes = hn::Zero(d);
    for (std::size_t i = begin; i < HWY_MIN(count, begin + block); i += hn::Lanes(d))
      lanes = hn::Add(lanes, term(i));
    sum += static_cast<double>(hn::GetLane(hn::SumOfLanes(d, lanes)));
  }
  return sum;
}

double sum_outside(const float* x, const float* mean, const float* bound, std::size_t count,
                   std::uint32_t* inside, std::size_t& inside_count) {
  const Floats d;
  const Indices di;
  std::size_t found = 0;
  const double sum = sum_of(count, [&](std::size_t i) HWY_ATTR {
    const V value = hn::Load(d, x + i);
    const auto within =
        hn::And(hn::Gt(value, hn::Load(d, bound + i)), hn::Lt(value, hn::LoadU(d, bound + i + 1)));
    if (!hn::AllFalse(d, within))
      found += hn::CompressStore(hn::Iota(di, static_cast<std::uint32_t>(i)),
                                 hn::RebindMask(di, within), di, inside + found);
    return hn::IfThenZeroElse(within, hn::Abs(hn::Sub(value, hn::Load(d, mean + i))));
  });
  inside_count = found;
  return sum;
}

double sum_differences(const float* x, const float* y, std::size_t count) {
  const Floats d;
  return sum_of(count, [&](std::size_t i) HWY_ATTR {
    return hn::Abs(hn::Sub(hn::Load(d, x + i), hn::Load(d, y + i)));
  });
}

void project(const float* direction, const Points& points, float* projections) {
  const Floats d;
  const V vx = hn::Set(d, direction[0]), vy = hn::Set(d, direction[1]),
          vz = hn::Set(d, direction[2]);
  const auto [x, y, z, count] = points;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const V along_x = hn::Mul(vx, hn::Load(d, x + i)), along_y = hn::Mul(vy, hn::Load(d, y + i));
    const V along_z = hn::Mul(vz, hn::Load(d, z + i));
    hn::Store(hn::Add(hn::Add(along_x, along_y), along_z), d, projections + i);
  }
}

}  // namespace ltc::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ltc::kernels {

HWY_EXPORT(sum_outside);
HWY_EXPORT(sum_differences);
HWY_EXPORT(project);

double sum_outside(const float* x, const float* mean, const float* bound, std::size_t count,
                   std::uint32_t* inside, std::size_t& inside_count) {
  return HWY_DYNAMIC_DISPATCH(sum_outside)(x, mean, bound, count, inside, inside_count);
}

double sum_differences(const float* x, const float* y, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(sum_differences)(x, y, count);
}

void project(const float* direction, const Points& points, float* projections) {
  HWY_DYNAMIC_DISPATCH(project)(direction, points, projections);
}

}  // namespace ltc::kernels
#endif
