// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Beckmann as a lobe model: what takes most of the time, vectorised for the processor at hand.
#include <array>
#include <cmath>
#include <numbers>

#include "brdf/beckmann.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "brdf/beckmann_model.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

#include "brdf/reflection-inl.h"

// What the kernels need to know of a lobe; shared by all targets.
#ifndef LTC_BECKMANN_KERNEL_ARGUMENTS
#define LTC_BECKMANN_KERNEL_ARGUMENTS
namespace ltc {

struct BeckmannArguments {
  float alpha_x, alpha_y;
  float view_x, view_y, view_z;
  BeckmannSampler::SlopeMap map;
  float rotation[9];  // of the target's kernel: Q, row-major
};

}  // namespace ltc
#endif

HWY_BEFORE_NAMESPACE();
namespace ltc::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using V = hn::Vec<Floats>;

// BeckmannSampler::sample in single precision.
class Samples {
 public:
  explicit HWY_INLINE Samples(const BeckmannArguments& lobe) : lobe_(lobe) {}

  struct Sample {
    Reflection<V> at;
    V weight;
  };

  // `minus_log` is -log(1 - u_height).
  HWY_INLINE Sample at(V cos_azimuth, V sin_azimuth, V minus_log) const {
    const Floats d;
    const V one = hn::Set(d, 1.0f);
    // Beyond seven the normal density has nothing left.
    const V radius = hn::Min(hn::Sqrt(minus_log), hn::Set(d, 7.0f));
    const V along = visible_slope(hn::Mul(radius, cos_azimuth));
    const V across = hn::Mul(radius, sin_azimuth);
    const V ex = hn::Set(d, static_cast<float>(lobe_.map.along_x));
    const V ey = hn::Set(d, static_cast<float>(lobe_.map.along_y));
    const V ax = hn::Set(d, lobe_.alpha_x), ay = hn::Set(d, lobe_.alpha_y);
    const V nx = hn::Mul(ax, hn::NegMulAdd(across, ey, hn::Mul(along, ex)));
    const V ny = hn::Mul(ay, hn::MulAdd(across, ex, hn::Mul(along, ey)));
    const V lateral = hn::MulAdd(nx, nx, hn::Mul(ny, ny));
    const V length = hn::Sqrt(hn::Add(one, lateral));
    const V scale = hn::Div(one, length);
    const V hz_less_one = hn::Neg(hn::Div(hn::Mul(lateral, scale), hn::Add(length, one)));
    const V vx = hn::Set(d, lobe_.view_x), vy = hn::Set(d, lobe_.view_y);
    const V vz = hn::Set(d, lobe_.view_z);
    const Reflection<V> at =
        reflect(d, vx, vy, vz, hn::Mul(nx, scale), hn::Mul(ny, scale), hz_less_one);
    const V lx = hn::Sub(at.ox, vx), ly = hn::Sub(at.oy, vy), lz = hn::Add(at.oz, vz);
    const V a = hn::Set(d, static_cast<float>(lobe_.map.one_plus_lambda_v));
    const V weight = hn::Div(a, hn::Add(a, lambda(hn::Mul(ax, lx), hn::Mul(ay, ly), lz)));
    return {at, hn::IfThenElseZero(hn::Gt(lz, hn::Zero(d)), weight)};
  }

 private:
  HWY_INLINE V visible_slope(V normal_slope) const {
    const Floats d;
    const hn::RebindToSigned<Floats> di;
    using Map = BeckmannSampler::SlopeMap;
    const V place = hn::Clamp(hn::MulAdd(normal_slope, hn::Set(d, BeckmannSampler::knots_a_unit),
                                         hn::Set(d, Map::cells / 2)),
                              hn::Zero(d), hn::Set(d, Map::cells));
    const auto cell = hn::Min(hn::ConvertTo(di, place), hn::Set(di, Map::cells - 1));
    const V t = hn::Sub(place, hn::ConvertTo(d, cell));
    const auto& coefficients = lobe_.map.coefficients;
    V value = hn::GatherIndex(d, coefficients[5].data(), cell);
    for (std::size_t power = 5; power-- > 0;)
      value = hn::MulAdd(value, t, hn::GatherIndex(d, coefficients[power].data(), cell));
    return value;
  }

  // (exp(-a^2)/(a sqrt(pi)) - erfc(a))/2 with erfc(a) = exp(-a^2) times a polynomial in
  // 1/(1 + p a) (Abramowitz and Stegun 7.1.26, to 1.5e-7): no more is asked of a weight.
  static HWY_INLINE V lambda(V stretched_x, V stretched_y, V z) {
    const Floats d;
    const V s = hn::Sqrt(hn::MulAdd(stretched_x, stretched_x, hn::Mul(stretched_y, stretched_y)));
    const V a = hn::Min(hn::Div(z, hn::Max(s, hn::Set(d, 1e-30f))), hn::Set(d, 9.0f));
    const V t = hn::Div(hn::Set(d, 1.0f), hn::MulAdd(a, hn::Set(d, 0.3275911f), hn::Set(d, 1.0f)));
    V erfc = hn::Set(d, 1.061405429f);
    for (const float coefficient : {-1.453152027f, 1.421413741f, -0.284496736f, 0.254829592f})
      erfc = hn::MulAdd(erfc, t, hn::Set(d, coefficient));
    const V reach = hn::Div(hn::Set(d, static_cast<float>(std::numbers::inv_sqrtpi)), a);
    const V left = hn::NegMulAdd(erfc, t, reach);
    return hn::Max(hn::Zero(d),
                   hn::Mul(hn::Mul(hn::Set(d, 0.5f), hn::Exp(d, hn::Neg(hn::Mul(a, a)))), left));
  }

  const BeckmannArguments& lobe_;
};

void BeckmannTarget(const BeckmannArguments& lobe, const TargetLattice& lattice,
                    TargetSamples& target) {
  const Floats d;
  const Samples samples(lobe);
  for (std::size_t i = 0; i < lattice.size(); i += hn::Lanes(d)) {
    const V u = hn::Load(d, lattice.height.data() + i);
    const Samples::Sample sample =
        samples.at(hn::Load(d, lattice.cos_azimuth.data() + i),
                   hn::Load(d, lattice.sin_azimuth.data() + i), hn::Neg(hn::Log1p(d, hn::Neg(u))));
    store_samples(d, lobe.rotation, sample.at, sample.weight, i, target);
  }
}

// Single-precision sums over a block of lanes, in double over the blocks.
Albedo BeckmannAlbedo(const BeckmannArguments& lobe, const AlbedoRule& rule) {
  const Floats d;
  const Samples samples(lobe);
  const V one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  Albedo sum;
  constexpr std::size_t stretch = 1024;
  for (std::size_t begin = 0; begin < rule.size(); begin += stretch) {
    alignas(64) std::array<float, AlbedoRule::block_size> amplitude{}, fresnel{};
    const std::size_t end = std::min(begin + stretch, rule.size());
    for (std::size_t block = begin; block < end; block += AlbedoRule::block_size)
      for (std::size_t lane = 0; lane < AlbedoRule::block_size; lane += hn::Lanes(d)) {
        const std::size_t i = block + lane;
        const V left = hn::Max(hn::LoadU(d, &rule.one_minus_height[i]), hn::Set(d, 1e-30f));
        const Samples::Sample sample =
            samples.at(hn::LoadU(d, &rule.cos_azimuth[i]), hn::LoadU(d, &rule.sin_azimuth[i]),
                       hn::Max(zero, hn::Neg(hn::Log(d, left))));
        const V weight = hn::Mul(hn::LoadU(d, &rule.weight[i]), sample.weight);
        const V x = hn::Max(hn::Sub(one, sample.at.v_dot_h), zero), squared = hn::Mul(x, x);
        const V schlick = hn::Mul(hn::Mul(squared, squared), x);
        hn::Store(hn::Add(hn::Load(d, &amplitude[lane]), weight), d, &amplitude[lane]);
        hn::Store(hn::MulAdd(weight, schlick, hn::Load(d, &fresnel[lane])), d, &fresnel[lane]);
      }
    for (std::size_t lane = 0; lane < AlbedoRule::block_size; ++lane) {
      sum.amplitude += static_cast<double>(amplitude[lane]);
      sum.fresnel += static_cast<double>(fresnel[lane]);
    }
  }
  return sum;
}

}  // namespace ltc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ltc {

HWY_EXPORT(BeckmannTarget);
HWY_EXPORT(BeckmannAlbedo);

namespace {

BeckmannArguments arguments_of(const Lobe& lobe) {
  const BeckmannSampler sampler(lobe);
  const Eigen::Vector3f v = sampler.omega_v().cast<float>();
  return {static_cast<float>(lobe.alpha_x),
          static_cast<float>(lobe.alpha_y),
          v.x(),
          v.y(),
          v.z(),
          sampler.slope_map(),
          {}};
}

class BeckmannModel final : public LobeModel {
 public:
  std::string_view name() const override { return "beckmann"; }
  std::string_view label() const override { return "Beckmann"; }
  std::unique_ptr<LobeSampler> sampler(const Lobe& lobe) const override {
    return std::make_unique<BeckmannSampler>(lobe);
  }

  void sample_target(const Lobe& lobe, const Eigen::Matrix3d& rotation,
                     const TargetLattice& lattice, TargetSamples& samples) const override {
    BeckmannArguments arguments = arguments_of(lobe);
    for (int i = 0; i < 9; ++i)
      arguments.rotation[i] = static_cast<float>(rotation(i / 3, i % 3));
    HWY_DYNAMIC_DISPATCH(BeckmannTarget)(arguments, lattice, samples);
  }
  Albedo albedo(const Lobe& lobe, const AlbedoRule& rule) const override {
    return HWY_DYNAMIC_DISPATCH(BeckmannAlbedo)(arguments_of(lobe), rule);
  }

  // Normal slopes have the mean absolute deviation alpha/sqrt(pi), those of a clamped cosine alpha.
  Eigen::Matrix3d first_order(const Lobe& lobe) const override {
    Eigen::Matrix3d matrix = LobeModel::first_order(lobe);
    matrix.leftCols<2>() *= std::numbers::inv_sqrtpi;
    return matrix;
  }
};

}  // namespace

const LobeModel& beckmann() {
  static const BeckmannModel model;
  return model;
}

}  // namespace ltc
#endif  // HWY_ONCE
