// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the kernels of microfacet models share, once for each instruction set (Highway's foreach).
#if defined(LTC_BRDF_REFLECTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LTC_BRDF_REFLECTION_INL_H_
#undef LTC_BRDF_REFLECTION_INL_H_
#else
#define LTC_BRDF_REFLECTION_INL_H_
#endif

#include <hwy/highway.h>

#include "brdf/lobe_model.h"

HWY_BEFORE_NAMESPACE();
namespace ltc::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The view direction reflected about microfacet normals: 2 (v.h) h - v less the mirror direction,
// and v.h. Normals have the third component 1 + hz_less_one, so that both are sums of small terms.
template <class V>
struct Reflection {
  V ox, oy, oz, v_dot_h;
};
template <class D, class V>
HWY_INLINE Reflection<V> reflect(D d, V vx, V vy, V vz, V hx, V hy, V hz_less_one) {
  const V two = hn::Set(d, 2.0f);
  const V dot_less_vz = hn::MulAdd(vx, hx, hn::MulAdd(vy, hy, hn::Mul(vz, hz_less_one)));
  const V dot = hn::Add(dot_less_vz, vz);
  return {hn::Mul(two, hn::Mul(dot, hx)), hn::Mul(two, hn::Mul(dot, hy)),
          hn::Mul(two, hn::MulAdd(dot, hz_less_one, dot_less_vz)), dot};
}

// Samples from i on: offsets turned into the frame whose axes are the columns of the row-major
// `rotation`, the last of them the mirror direction m. m . (l - m) = -|l - m|^2 / 2 for unit
// vectors.
template <class D, class V>
HWY_INLINE void store_samples(D d, const float* rotation, const Reflection<V>& at, V weight,
                              std::size_t i, TargetSamples& samples) {
  const float* const q = rotation;
  hn::Store(weight, d, samples.weight.data() + i);
  hn::Store(hn::MulAdd(hn::Set(d, q[0]), at.ox,
                       hn::MulAdd(hn::Set(d, q[3]), at.oy, hn::Mul(hn::Set(d, q[6]), at.oz))),
            d, samples.gx.data() + i);
  hn::Store(hn::MulAdd(hn::Set(d, q[1]), at.ox,
                       hn::MulAdd(hn::Set(d, q[4]), at.oy, hn::Mul(hn::Set(d, q[7]), at.oz))),
            d, samples.gy.data() + i);
  const V squared = hn::MulAdd(at.ox, at.ox, hn::MulAdd(at.oy, at.oy, hn::Mul(at.oz, at.oz)));
  hn::Store(hn::Neg(hn::Mul(hn::Set(d, 0.5f), squared)), d, samples.gz.data() + i);
}

}  // namespace ltc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
