// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Quadrature of the GGX lobe over its visible normals, vectorised for the processor at hand.
#include "brdf/albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/albedo.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

// What the kernel needs to know of a lobe and of a rule; shared by all targets.
#ifndef LTC_ALBEDO_KERNEL_ARGUMENTS
#define LTC_ALBEDO_KERNEL_ARGUMENTS
namespace ltc {

struct AlbedoLobe {
  float alpha_x, alpha_y;
  float vx, vy, vz;
  float stretched_x, stretched_y;  // stretched view direction of unit length
  float one_plus_stretched_z, one_minus_stretched_z;
  float one_plus_lambda_v;
};

}  // namespace ltc
#endif

HWY_BEFORE_NAMESPACE();
namespace ltc::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The integrals are means over visible normals of G2/G1 = a/(a + Lambda(l)), a = 1 + Lambda(v),
// without and with (1 - v.h)^5. With H an unnormalised microfacet normal:
//   l = 2 (v.H)/|H|^2 H - v,   v.h = sqrt((v.H) (v.H)/|H|^2),
//   a/(a + Lambda(l)) = q/(q + s^2),  q = 2 a z (z + sqrt(z^2 + s^2)),  s^2 = (ax lx)^2 + (ay ly)^2
// and z = max(lz, 0), which makes the weight zero below the horizon without a division by zero.
// Products and sums are written out, not fused, for the same bits on every target.
Albedo AlbedoKernel(const AlbedoLobe& lobe, const AlbedoRule& rule) {
  const hn::CappedTag<float, AlbedoRule::block_size> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const auto alpha_x = hn::Set(d, lobe.alpha_x), alpha_y = hn::Set(d, lobe.alpha_y);
  const auto vx = hn::Set(d, lobe.vx), vy = hn::Set(d, lobe.vy), vz = hn::Set(d, lobe.vz);
  const auto stretched_x = hn::Set(d, lobe.stretched_x), stretched_y = hn::Set(d, lobe.stretched_y);
  const auto depth_of_cap = hn::Set(d, lobe.one_plus_stretched_z);
  const auto below_cap = hn::Set(d, lobe.one_minus_stretched_z);
  const auto two_a = hn::Set(d, 2 * lobe.one_plus_lambda_v);

  // Single-precision partial sums over a stretch of points, then double over the stretches.
  constexpr std::size_t kStretch = 64 * AlbedoRule::block_size;
  double amplitude_sum = 0, fresnel_sum = 0;
  for (std::size_t begin = 0; begin < rule.size(); begin += kStretch) {
    const std::size_t end = std::min(begin + kStretch, rule.size());
    HWY_ALIGN std::array<float, AlbedoRule::block_size> amplitude{}, fresnel{};
    for (std::size_t block = begin; block < end; block += AlbedoRule::block_size) {
      for (std::size_t lane = 0; lane < AlbedoRule::block_size; lane += lanes) {
        const std::size_t i = block + lane;
        const auto depth = hn::Mul(hn::LoadU(d, &rule.height[i]), depth_of_cap);
        const auto hz = hn::Mul(hn::LoadU(d, &rule.one_minus_height[i]), depth_of_cap);
        const auto sine = hn::Sqrt(hn::Mul(depth, hn::Add(hz, below_cap)));
        const auto hx = hn::Mul(
            alpha_x, hn::Add(hn::Mul(sine, hn::LoadU(d, &rule.cos_azimuth[i])), stretched_x));
        const auto hy = hn::Mul(
            alpha_y, hn::Add(hn::Mul(sine, hn::LoadU(d, &rule.sin_azimuth[i])), stretched_y));
        const auto h_squared = hn::Add(hn::Add(hn::Mul(hx, hx), hn::Mul(hy, hy)), hn::Mul(hz, hz));
        const auto v_dot_h =
            hn::Max(hn::Add(hn::Add(hn::Mul(vx, hx), hn::Mul(vy, hy)), hn::Mul(vz, hz)), zero);
        const auto ratio = hn::Div(v_dot_h, h_squared);
        const auto twice_ratio = hn::Add(ratio, ratio);

        const auto lx = hn::Mul(alpha_x, hn::Sub(hn::Mul(twice_ratio, hx), vx));
        const auto ly = hn::Mul(alpha_y, hn::Sub(hn::Mul(twice_ratio, hy), vy));
        const auto lz = hn::Max(hn::Sub(hn::Mul(twice_ratio, hz), vz), zero);
        const auto s_squared = hn::Add(hn::Mul(lx, lx), hn::Mul(ly, ly));
        const auto root = hn::Sqrt(hn::Add(hn::Mul(lz, lz), s_squared));
        const auto q = hn::Mul(hn::Mul(two_a, lz), hn::Add(lz, root));
        const auto weight =
            hn::Mul(hn::LoadU(d, &rule.weight[i]), hn::Div(q, hn::Add(q, s_squared)));

        const auto one_minus_cosine =
            hn::Max(hn::Sub(one, hn::Sqrt(hn::Mul(v_dot_h, ratio))), zero);
        const auto squared = hn::Mul(one_minus_cosine, one_minus_cosine);
        const auto schlick = hn::Mul(hn::Mul(squared, squared), one_minus_cosine);
        hn::StoreU(hn::Add(hn::LoadU(d, &amplitude[lane]), weight), d, &amplitude[lane]);
        hn::StoreU(hn::Add(hn::LoadU(d, &fresnel[lane]), hn::Mul(weight, schlick)), d,
                   &fresnel[lane]);
      }
    }
    for (std::size_t lane = 0; lane < AlbedoRule::block_size; ++lane) {
      amplitude_sum += static_cast<double>(amplitude[lane]);
      fresnel_sum += static_cast<double>(fresnel[lane]);
    }
  }
  return {amplitude_sum, fresnel_sum};
}

}  // namespace ltc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ltc {

HWY_EXPORT(AlbedoKernel);

AlbedoRule::AlbedoRule(std::size_t points) {
  const std::size_t count = (points + block_size - 1) / block_size * block_size;
  for (std::vector<float>* column :
       {&cos_azimuth, &sin_azimuth, &height, &one_minus_height, &weight})
    column->resize(count);
  const double golden = std::numbers::phi - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double turns = golden * static_cast<double>(i);
    const double azimuth = 2 * std::numbers::pi * (turns - std::floor(turns));
    const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    cos_azimuth[i] = static_cast<float>(std::cos(azimuth));
    sin_azimuth[i] = static_cast<float>(std::sin(azimuth));
    height[i] = static_cast<float>(t * t * (3 - 2 * t));
    one_minus_height[i] = static_cast<float>((1 - t) * (1 - t) * (1 + 2 * t));
    weight[i] = static_cast<float>(6 * t * (1 - t) / static_cast<double>(count));
  }
}

Albedo integrate_albedo(const Lobe& lobe, const AlbedoRule& rule) {
  const Eigen::Vector3d v = lobe.omega_v();
  const Eigen::Vector3d stretched =
      Eigen::Vector3d(lobe.alpha_x * v.x(), lobe.alpha_y * v.y(), v.z()).normalized();
  const AlbedoLobe arguments{
      static_cast<float>(lobe.alpha_x),
      static_cast<float>(lobe.alpha_y),
      static_cast<float>(v.x()),
      static_cast<float>(v.y()),
      static_cast<float>(v.z()),
      static_cast<float>(stretched.x()),
      static_cast<float>(stretched.y()),
      static_cast<float>(1 + stretched.z()),
      static_cast<float>(stretched.head<2>().squaredNorm() / (1 + stretched.z())),
      static_cast<float>(1 + ggx_lambda(lobe.alpha_x, lobe.alpha_y, v))};
  return HWY_DYNAMIC_DISPATCH(AlbedoKernel)(arguments, rule);
}

}  // namespace ltc
#endif  // HWY_ONCE
