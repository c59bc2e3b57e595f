// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/arc_kernels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/gauss_rule.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fit/arc_kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
// After foreach_target.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#ifndef LTC_ARC_KERNEL_ARGUMENTS
#define LTC_ARC_KERNEL_ARGUMENTS
namespace ltc::kernels {

// Numbers of a cone: C (xx xy xz yy yz zz), W^T d, d, t, and which pair it is of.
enum ConeNumber {
  kXX,
  kXY,
  kXZ,
  kYY,
  kYZ,
  kZZ,
  kWx,
  kWy,
  kWz,
  kDx,
  kDy,
  kDz,
  kT,
  kPair,
  kConeNumbers
};

// Cones one after the other in structure of arrays: number n of cone i is data[n stride + i].
struct Cones {
  const double* data;
  std::size_t stride, count;  // count padded to whole vectors
};

// Where they are made: those that the horizon cuts, and whole ones.
struct ConeLists {
  double* cut;
  double* whole;
  std::size_t stride;
  std::size_t cut_count = 0, whole_count = 0;
};

// F of each, and dF/dW (null: none), row-major, in structure of arrays of `stride`.
struct ConeResults {
  double* f;
  double* jacobian;
  std::size_t stride;
};

}  // namespace ltc::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace ltc::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, arc_lanes>;
using V = hn::Vec<Doubles>;

// A symmetric matrix of each lane.
struct Symmetric {
  V xx, xy, xz, yy, yz, zz;
};

// `up` is the horizon's normal as W leaves it, on the lobe's side.
void MakeCones(const double* w, const double* up, const ArcPairs& pairs, double* f,
               ConeLists& lists) {
  const Doubles d;
  const std::size_t lanes = hn::Lanes(d);
  double gram[3][3];
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      gram[a][b] = w[a] * w[b] + w[3 + a] * w[3 + b] + w[6 + a] * w[6 + b];
  const auto set = [&](double value) { return hn::Set(d, value); };
  const V one = set(1.0), zero = hn::Zero(d);
  for (std::size_t i = 0; i < pairs.count; i += lanes) {
    // Turned to t > 0.
    const V given = hn::Load(d, pairs.t + i);
    const V t = hn::Abs(given), sign = hn::And(given, set(-0.0));
    const V dx = hn::Xor(hn::Load(d, pairs.dx + i), sign);
    const V dy = hn::Xor(hn::Load(d, pairs.dy + i), sign);
    const V dz = hn::Xor(hn::Load(d, pairs.dz + i), sign);
    const V t2 = hn::Mul(t, t);
    const auto along = [&](std::size_t column) {
      return hn::MulAdd(set(w[column]), dx,
                        hn::MulAdd(set(w[3 + column]), dy, hn::Mul(set(w[6 + column]), dz)));
    };
    const V wx = along(0), wy = along(1), wz = along(2);
    V numbers[kConeNumbers];
    numbers[kXX] = hn::NegMulAdd(t2, set(gram[0][0]), hn::Mul(wx, wx));
    numbers[kXY] = hn::NegMulAdd(t2, set(gram[0][1]), hn::Mul(wx, wy));
    numbers[kXZ] = hn::NegMulAdd(t2, set(gram[0][2]), hn::Mul(wx, wz));
    numbers[kYY] = hn::NegMulAdd(t2, set(gram[1][1]), hn::Mul(wy, wy));
    numbers[kYZ] = hn::NegMulAdd(t2, set(gram[1][2]), hn::Mul(wy, wz));
    numbers[kZZ] = hn::NegMulAdd(t2, set(gram[2][2]), hn::Mul(wz, wz));
    numbers[kWx] = wx;
    numbers[kWy] = wy;
    numbers[kWz] = wz;
    numbers[kDx] = dx;
    numbers[kDy] = dy;
    numbers[kDz] = dz;
    numbers[kT] = t;
    numbers[kPair] = hn::Iota(d, static_cast<double>(i));
    const auto has_edge = hn::Lt(t, one);
    const auto is_cut =
        hn::Lt(hn::Mul(numbers[kXX], numbers[kYY]), hn::Mul(numbers[kXY], numbers[kXY]));
    const V height =
        hn::MulAdd(dx, set(up[0]), hn::MulAdd(dy, set(up[1]), hn::Mul(dz, set(up[2]))));
    const auto cut = hn::And(has_edge, is_cut);
    const auto whole = hn::And(has_edge, hn::AndNot(is_cut, hn::Gt(height, zero)));
    // Highway 1.0's own Compress copies a table with every call.
    const auto append = [&](hn::Mask<Doubles> chosen, double* list, std::size_t& count) {
      std::uint8_t bits[arc_lanes] = {};
      hn::StoreMaskBits(d, chosen, bits);
      HWY_ALIGN std::int64_t from[arc_lanes + 1] = {};
      std::size_t kept = 0;
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        from[kept] = static_cast<std::int64_t>(lane);
        kept += bits[0] >> lane & 1u;
      }
      const auto indices = hn::SetTableIndices(d, from);
      for (std::size_t n = 0; n < kConeNumbers; ++n)
        hn::StoreU(hn::TableLookupLanes(numbers[n], indices), d, list + n * lists.stride + count);
      count += kept;
    };
    if (!hn::AllFalse(d, cut))
      append(cut, lists.cut, lists.cut_count);
    if (!hn::AllFalse(d, whole))
      append(whole, lists.whole, lists.whole_count);
    hn::Store(zero, d, f + i);
  }
}

Symmetric load_cone(const Cones& cones, std::size_t i) {
  const Doubles d;
  const auto number = [&](std::size_t n) { return hn::Load(d, cones.data + n * cones.stride + i); };
  return {number(kXX), number(kXY), number(kXZ), number(kYY), number(kYZ), number(kZZ)};
}

// 2 N W T of each lane.
void store_jacobian(const double* w, const Cones& cones, std::size_t i, const Symmetric& slope,
                    const ConeResults& results) {
  const Doubles d;
  const auto number = [&](std::size_t n) { return hn::Load(d, cones.data + n * cones.stride + i); };
  const V wx = number(kWx), wy = number(kWy), wz = number(kWz), t = number(kT);
  const V two = hn::Set(d, 2.0), t2 = hn::Mul(t, t);
  const V columns[3][3] = {{slope.xx, slope.xy, slope.xz},
                           {slope.xy, slope.yy, slope.yz},
                           {slope.xz, slope.yz, slope.zz}};
  const V towards[3] = {number(kDx), number(kDy), number(kDz)};
  for (std::size_t c = 0; c < 3; ++c) {
    const V* s = columns[c];
    const V along = hn::MulAdd(wx, s[0], hn::MulAdd(wy, s[1], hn::Mul(wz, s[2])));
    for (std::size_t r = 0; r < 3; ++r) {
      const double* row = w + 3 * r;
      const V of_w =
          hn::MulAdd(hn::Set(d, row[0]), s[0],
                     hn::MulAdd(hn::Set(d, row[1]), s[1], hn::Mul(hn::Set(d, row[2]), s[2])));
      const V entry = hn::Mul(two, hn::NegMulAdd(t2, of_w, hn::Mul(towards[r], along)));
      hn::Store(entry, d, results.jacobian + (3 * r + c) * results.stride + i);
    }
  }
}

// q and what C is in the frame (q, u, z).
struct HorizonFrame {
  V qx, qy;
  V qq, uu, qz, uz, zz;
};
HorizonFrame horizon_frame(const Cones& cones, std::size_t i, const Symmetric& c) {
  const Doubles d;
  const V half = hn::Set(d, 0.5), one = hn::Set(d, 1.0), zero = hn::Zero(d);
  const V mean = hn::Mul(half, hn::Add(c.xx, c.yy));
  const V difference = hn::Mul(half, hn::Sub(c.xx, c.yy));
  const V radius = hn::Sqrt(hn::MulAdd(difference, difference, hn::Mul(c.xy, c.xy)));
  const V determinant = hn::NegMulAdd(c.xy, c.xy, hn::Mul(c.xx, c.yy));
  // The one of larger size from the sum, the other from the product: neither cancels.
  const auto positive_mean = hn::Gt(mean, zero);
  const V larger = hn::IfThenElse(positive_mean, hn::Add(mean, radius), hn::Sub(mean, radius));
  const V smaller = hn::Div(determinant, larger);
  const V qq = hn::IfThenElse(positive_mean, larger, smaller);
  const V uu = hn::IfThenElse(positive_mean, smaller, larger);
  const V cos2 = hn::Div(difference, radius), sin2 = hn::Div(c.xy, radius);
  const V long_side = hn::Sqrt(hn::Mul(half, hn::Add(one, hn::Abs(cos2))));
  const V short_side = hn::Div(hn::Mul(half, sin2), long_side);
  const auto along_x = hn::Ge(difference, zero);
  V qx = hn::IfThenElse(along_x, long_side, short_side);
  V qy = hn::IfThenElse(along_x, short_side, long_side);
  const V wx = hn::Load(d, cones.data + kWx * cones.stride + i);
  const V wy = hn::Load(d, cones.data + kWy * cones.stride + i);
  const V ahead = hn::MulAdd(wx, qx, hn::Mul(wy, qy));
  const auto behind = hn::Lt(ahead, zero);
  qx = hn::IfThenElse(behind, hn::Neg(qx), qx);
  qy = hn::IfThenElse(behind, hn::Neg(qy), qy);
  const V qz = hn::MulAdd(c.xz, qx, hn::Mul(c.yz, qy));
  const V uz = hn::MulSub(c.yz, qx, hn::Mul(c.xz, qy));
  return {qx, qy, qq, uu, qz, uz, c.zz};
}

void CutCones(const double* w, const Cones& cones, const ArcNodes& nodes,
              const ConeResults& results) {
  const Doubles d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0), two = hn::Set(d, 2.0);
  const V quarter_turn = hn::Set(d, std::numbers::pi / 2);
  const V least = hn::Set(d, 1e-280);
  const bool slopes = results.jacobian != nullptr;
  for (std::size_t i = 0; i < cones.count; i += hn::Lanes(d)) {
    const HorizonFrame frame = horizon_frame(cones, i, load_cone(cones, i));
    V f = zero;
    Symmetric sum{zero, zero, zero, zero, zero, zero};  // in (q, u, z)
    for (std::size_t node = 0; node < nodes.sine.size(); ++node) {
      const V s = hn::Set(d, nodes.sine[node]), c = hn::Set(d, nodes.cosine[node]);
      const V weight = hn::Set(d, nodes.weight[node]);
      const V b = hn::Mul(c, frame.qz);
      const V ee =
          hn::MulAdd(hn::Mul(s, s), frame.uu,
                     hn::Mul(c, hn::MulAdd(hn::Mul(two, s), frame.uz, hn::Mul(c, frame.zz))));
      const V r = hn::Sqrt(hn::Max(hn::NegMulAdd(frame.qq, ee, hn::Mul(b, b)), least));
      const auto forward = hn::Gt(b, zero);
      const V numerator = hn::IfThenElse(forward, hn::Neg(ee), hn::Sub(r, b));
      const V denominator = hn::IfThenElse(forward, hn::Add(b, r), frame.qq);
      const V x = hn::Div(numerator, denominator);
      const V squared = hn::Div(one, hn::MulAdd(x, x, one));
      const V angle = hn::Sub(quarter_turn, hn::Atan(d, x));
      f = hn::MulAdd(weight, hn::NegMulAdd(x, squared, angle), f);
      if (!slopes)
        continue;
      const V k = hn::Div(hn::Mul(weight, hn::Mul(squared, squared)), r);
      const V kx = hn::Mul(k, x), ks = hn::Mul(k, s), kc = hn::Mul(k, c);
      sum.xx = hn::MulAdd(kx, x, sum.xx);
      sum.xy = hn::MulAdd(kx, s, sum.xy);
      sum.xz = hn::MulAdd(kx, c, sum.xz);
      sum.yy = hn::MulAdd(ks, s, sum.yy);
      sum.yz = hn::MulAdd(ks, c, sum.yz);
      sum.zz = hn::MulAdd(kc, c, sum.zz);
    }
    hn::Store(f, d, results.f + i);
    if (!slopes)
      continue;
    const V qx = frame.qx, qy = frame.qy;
    const V xx = hn::Mul(qx, qx), xy = hn::Mul(qx, qy), yy = hn::Mul(qy, qy);
    const V cross = hn::Mul(two, hn::Mul(xy, sum.xy));
    const Symmetric slope{hn::MulAdd(xx, sum.xx, hn::Sub(hn::Mul(yy, sum.yy), cross)),
                          hn::MulAdd(xy, hn::Sub(sum.xx, sum.yy), hn::Mul(hn::Sub(xx, yy), sum.xy)),
                          hn::MulSub(qx, sum.xz, hn::Mul(qy, sum.yz)),
                          hn::MulAdd(yy, sum.xx, hn::MulAdd(xx, sum.yy, cross)),
                          hn::MulAdd(qy, sum.xz, hn::Mul(qx, sum.yz)),
                          sum.zz};
    store_jacobian(w, cones, i, slope, results);
  }
}

// The positive eigenvalue of C, by Newton's method on its characteristic polynomial
//     p(x) = x^3 - trace x^2 + minors x - determinant,
// whose determinant is known without cancellation. Sharp lobes have two eigenvalues near zero that
// trigonometric formulas cannot tell apart. The norm of C is an upper bound; so is, where the trace
// is negative, the root that p has without its cube. One of them is less than 2.3 times too large.
V positive_eigenvalue(const Symmetric& c, V determinant) {
  const Doubles d;
  const V zero = hn::Zero(d);
  const V trace = hn::Add(c.xx, hn::Add(c.yy, c.zz));
  const V minors = hn::Add(hn::MulSub(c.xx, c.yy, hn::Mul(c.xy, c.xy)),
                           hn::Add(hn::MulSub(c.xx, c.zz, hn::Mul(c.xz, c.xz)),
                                   hn::MulSub(c.yy, c.zz, hn::Mul(c.yz, c.yz))));
  const V off = hn::MulAdd(c.xy, c.xy, hn::MulAdd(c.xz, c.xz, hn::Mul(c.yz, c.yz)));
  const V norm = hn::Sqrt(hn::MulAdd(
      hn::Set(d, 2.0), off, hn::MulAdd(c.xx, c.xx, hn::MulAdd(c.yy, c.yy, hn::Mul(c.zz, c.zz)))));
  // -trace x^2 + minors x - determinant = 0
  const V twice = hn::Abs(hn::Add(trace, trace));
  const V root = hn::Sqrt(
      hn::Max(hn::MulAdd(minors, minors, hn::Mul(hn::Add(twice, twice), determinant)), zero));
  const V above = hn::IfThenElse(hn::Gt(minors, zero),
                                 hn::Div(hn::Add(determinant, determinant), hn::Add(minors, root)),
                                 hn::Div(hn::Sub(root, minors), twice));
  V x = hn::IfThenElse(hn::Lt(trace, zero), hn::Min(above, norm), norm);
  constexpr int iterations = 6;
  for (int i = 0; i < iterations; ++i) {
    const V value = hn::MulSub(hn::MulAdd(hn::Sub(x, trace), x, minors), x, determinant);
    const V slope = hn::MulAdd(hn::MulSub(hn::Set(d, 3.0), x, hn::Add(trace, trace)), x, minors);
    x = hn::IfThenElse(hn::Gt(slope, zero), hn::Sub(x, hn::Div(value, slope)), x);
  }
  return hn::Max(x, hn::Set(d, 1e-300));
}

void WholeCones(const double* w, const Cones& cones, const ConeResults& results) {
  const Doubles d;
  const V half = hn::Set(d, 0.5), one = hn::Set(d, 1.0), tiny = hn::Set(d, 1e-280);
  const double det_w = w[0] * (w[4] * w[8] - w[5] * w[7]) - w[1] * (w[3] * w[8] - w[5] * w[6]) +
                       w[2] * (w[3] * w[7] - w[4] * w[6]);
  for (std::size_t i = 0; i < cones.count; i += hn::Lanes(d)) {
    const Symmetric c = load_cone(cones, i);
    const V t = hn::Load(d, cones.data + kT * cones.stride + i), t2 = hn::Mul(t, t);
    const V determinant =
        hn::Mul(hn::Set(d, det_w * det_w), hn::Mul(hn::Mul(t2, t2), hn::Sub(one, t2)));
    const V lambda = positive_eigenvalue(c, determinant);
    const V bx = hn::Sub(c.xx, lambda), by = hn::Sub(c.yy, lambda), bz = hn::Sub(c.zz, lambda);
    const Symmetric e{hn::MulSub(by, bz, hn::Mul(c.yz, c.yz)),
                      hn::MulSub(c.xz, c.yz, hn::Mul(c.xy, bz)),
                      hn::MulSub(c.xy, c.yz, hn::Mul(by, c.xz)),
                      hn::MulSub(bx, bz, hn::Mul(c.xz, c.xz)),
                      hn::MulSub(c.xy, c.xz, hn::Mul(bx, c.yz)),
                      hn::Max(hn::MulSub(bx, by, hn::Mul(c.xy, c.xy)), tiny)};
    const V inverse = hn::Div(one, hn::Max(hn::Add(e.xx, hn::Add(e.yy, e.zz)), tiny));
    const V over_lambda = hn::Mul(hn::Sqrt(e.zz), inverse), f = hn::Mul(lambda, over_lambda);
    hn::Store(f, d, results.f + i);
    if (!results.jacobian)
      continue;
    // dF/dC = E/S (F/lambda - F (b_x + b_y)/(2 E_zz) + 2 F tr B/S) + F/(2 E_zz) dE_zz/dC
    //         - F/S (tr B I - B),   B = C - lambda I.
    const V trace = hn::Add(bx, hn::Add(by, bz));
    const V up = hn::Mul(half, hn::Div(f, e.zz)), down = hn::Mul(f, inverse);
    const V of_e = hn::Mul(
        inverse, hn::Add(over_lambda,
                         hn::NegMulAdd(up, hn::Add(bx, by), hn::Mul(hn::Add(trace, trace), down))));
    const Symmetric slope{
        hn::MulAdd(of_e, e.xx, hn::MulSub(up, by, hn::Mul(down, hn::Sub(trace, bx)))),
        hn::MulAdd(of_e, e.xy, hn::Mul(hn::Sub(down, up), c.xy)),
        hn::MulAdd(of_e, e.xz, hn::Mul(down, c.xz)),
        hn::MulAdd(of_e, e.yy, hn::MulSub(up, bx, hn::Mul(down, hn::Sub(trace, by)))),
        hn::MulAdd(of_e, e.yz, hn::Mul(down, c.yz)),
        hn::NegMulAdd(down, hn::Sub(trace, bz), hn::Mul(of_e, e.zz))};
    store_jacobian(w, cones, i, slope, results);
  }
}

// Sums over lanes of `width` in one order whatever vectors there are, so that every vector unit
// finds the same bits: part by part of such a row, then lane by lane.
template <typename T, std::size_t width>
T sum_of_row(const T (&row)[width]) {
  T sum = 0;
  for (const T value : row)
    sum += value;
  return sum;
}

void ArcSums(const double* jacobian, std::size_t stride, std::size_t count, const double* first,
             const double* second, double* gradient, double* curvature) {
  const Doubles d;
  for (std::size_t a = 0; a < 9; ++a) {
    const double* of_a = jacobian + a * stride;
    HWY_ALIGN double sums[arc_lanes], products[9][arc_lanes];
    for (std::size_t part = 0; part < arc_lanes; part += hn::Lanes(d)) {
      V sum = hn::Zero(d), product[9];
      for (std::size_t b = a; b < 9; ++b)
        product[b] = hn::Zero(d);
      for (std::size_t i = part; i < count; i += arc_lanes) {
        const V value = hn::Load(d, of_a + i);
        sum = hn::MulAdd(value, hn::Load(d, first + i), sum);
        const V weighted = hn::Mul(value, hn::Load(d, second + i));
        for (std::size_t b = a; b < 9; ++b)
          product[b] = hn::MulAdd(weighted, hn::Load(d, jacobian + b * stride + i), product[b]);
      }
      hn::Store(sum, d, sums + part);
      for (std::size_t b = a; b < 9; ++b)
        hn::Store(product[b], d, products[b] + part);
    }
    gradient[a] = sum_of_row(sums);
    for (std::size_t b = a; b < 9; ++b)
      curvature[9 * a + b] = curvature[9 * b + a] = sum_of_row(products[b]);
  }
}

constexpr std::size_t sample_lanes = 16;

ArcCounts CountAbove(const float* direction, const Points& g, const float* weight, const double* z,
                     const double* ramp, std::size_t thresholds, float* xi, double* above) {
  const hn::CappedTag<float, sample_lanes> d;
  using F = hn::Vec<decltype(d)>;
  const std::size_t lanes = hn::Lanes(d);
  const F dx = hn::Set(d, direction[0]), dy = hn::Set(d, direction[1]),
          dz = hn::Set(d, direction[2]);
  HWY_ALIGN float totals[sample_lanes], firsts[sample_lanes], deviations[sample_lanes];
  for (std::size_t part = 0; part < sample_lanes; part += lanes) {
    F total = hn::Zero(d), first = hn::Zero(d);
    for (std::size_t i = part; i < g.count; i += sample_lanes) {
      const F value =
          hn::MulAdd(dx, hn::Load(d, g.x + i),
                     hn::MulAdd(dy, hn::Load(d, g.y + i), hn::Mul(dz, hn::Load(d, g.z + i))));
      const F w = hn::Load(d, weight + i);
      hn::Store(value, d, xi + i);
      total = hn::Add(total, w);
      first = hn::MulAdd(w, value, first);
    }
    hn::Store(total, d, totals + part);
    hn::Store(first, d, firsts + part);
  }
  const double whole = static_cast<double>(sum_of_row(totals));
  const double centre = static_cast<double>(sum_of_row(firsts)) / whole;
  const F middle = hn::Set(d, static_cast<float>(centre));
  for (std::size_t part = 0; part < sample_lanes; part += lanes) {
    F deviation = hn::Zero(d);
    for (std::size_t i = part; i < g.count; i += sample_lanes)
      deviation = hn::MulAdd(hn::Load(d, weight + i), hn::Abs(hn::Sub(hn::Load(d, xi + i), middle)),
                             deviation);
    hn::Store(deviation, d, deviations + part);
  }
  const double scale = std::max(static_cast<double>(sum_of_row(deviations)) / whole, 1e-30);
  const F one = hn::Set(d, 1.0f);
  constexpr std::size_t at_once = 4;
  for (std::size_t j = 0; j < thresholds; j += at_once) {
    // A sample's share above the ramp about a threshold is slope x + offset, from 0 to 1.
    F slope[at_once], offset[at_once];
    for (std::size_t k = 0; k < at_once; ++k) {
      const std::size_t at = std::min(j + k, thresholds - 1);
      const double steepness = 1 / (scale * ramp[at]);
      slope[k] = hn::Set(d, static_cast<float>(steepness));
      offset[k] = hn::Set(d, static_cast<float>(0.5 - (centre + scale * z[at]) * steepness));
    }
    HWY_ALIGN float sums[at_once][sample_lanes];
    for (std::size_t part = 0; part < sample_lanes; part += lanes) {
      F sum[at_once];
      for (std::size_t k = 0; k < at_once; ++k)
        sum[k] = hn::Zero(d);
      for (std::size_t i = part; i < g.count; i += sample_lanes) {
        const F value = hn::Load(d, xi + i), w = hn::Load(d, weight + i);
        for (std::size_t k = 0; k < at_once; ++k)
          sum[k] = hn::MulAdd(
              w, hn::Min(hn::Max(hn::MulAdd(slope[k], value, offset[k]), hn::Zero(d)), one),
              sum[k]);
      }
      for (std::size_t k = 0; k < at_once; ++k)
        hn::Store(sum[k], d, sums[k] + part);
    }
    for (std::size_t k = 0; k < at_once && j + k < thresholds; ++k)
      above[j + k] = static_cast<double>(sum_of_row(sums[k])) / whole;
  }
  return {centre, scale};
}

}  // namespace ltc::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ltc::kernels {

HWY_EXPORT(MakeCones);
HWY_EXPORT(CutCones);
HWY_EXPORT(WholeCones);
HWY_EXPORT(ArcSums);
HWY_EXPORT(CountAbove);

namespace {

void grow(AlignedVector<double>& array, std::size_t size) {
  if (array.size() < size)
    array.resize(size);
}

}  // namespace

ArcNodes::ArcNodes(std::size_t count) {
  constexpr double quarter = std::numbers::pi / 2;
  for (const GaussNode& node : gauss_nodes(count)) {
    const double psi = quarter * node.place;
    sine.push_back(std::sin(psi));
    cosine.push_back(std::cos(psi));
    weight.push_back(quarter * node.weight * std::cos(psi) / (2 * std::numbers::pi));
  }
}

void ArcDistributions::evaluate(const double* w, const ArcPairs& pairs, const ArcNodes& nodes,
                                bool derivatives) {
  const std::size_t stride = pairs.count + arc_lanes;
  grow(cut_, kConeNumbers * stride);
  grow(whole_, kConeNumbers * stride);
  grow(cone_f_, stride);
  grow(f, pairs.count);
  jacobian_stride = pairs.count + 2 * arc_lanes;
  grow(jacobian, derivatives ? 9 * jacobian_stride : 0);
  double up[3] = {w[3] * w[7] - w[6] * w[4], w[6] * w[1] - w[0] * w[7], w[0] * w[4] - w[3] * w[1]};
  if (up[0] * w[2] + up[1] * w[5] + up[2] * w[8] < 0)
    for (double& entry : up)
      entry = -entry;
  ConeLists lists{cut_.data(), whole_.data(), stride};
  HWY_DYNAMIC_DISPATCH(MakeCones)(w, up, pairs, f.data(), lists);
  moving.clear();
  const auto take = [&](double* cones, std::size_t count, auto&& evaluate_cones) {
    if (count == 0)
      return;
    const std::size_t begin = moving.size(), size = padded_to_lanes(count);
    for (std::size_t number = 0; number < kConeNumbers; ++number)
      std::fill_n(cones + number * stride + count, size - count,
                  cones[number * stride + count - 1]);
    evaluate_cones(Cones{cones, stride, size},
                   ConeResults{cone_f_.data(), derivatives ? jacobian.data() + begin : nullptr,
                               jacobian_stride});
    moving.resize(begin + size, -1);
    for (std::size_t i = 0; i < count; ++i) {
      const auto pair = static_cast<std::int32_t>(cones[kPair * stride + i]);
      moving[begin + i] = pair;
      f[static_cast<std::size_t>(pair)] = cone_f_[i];
    }
  };
  take(cut_.data(), lists.cut_count, [&](const Cones& of, const ConeResults& results) {
    HWY_DYNAMIC_DISPATCH(CutCones)(w, of, nodes, results);
  });
  take(whole_.data(), lists.whole_count, [&](const Cones& of, const ConeResults& results) {
    HWY_DYNAMIC_DISPATCH(WholeCones)(w, of, results);
  });
  for (std::size_t i = 0; i < pairs.count; ++i)
    if (pairs.t[i] < 0)
      f[i] = 1 - f[i];
}

void arc_sums(const ArcDistributions& distributions, const double* first, const double* second,
              double* gradient, double* curvature) {
  HWY_DYNAMIC_DISPATCH(ArcSums)
  (distributions.jacobian.data(), distributions.jacobian_stride, distributions.moving.size(), first,
   second, gradient, curvature);
}

ArcCounts count_above(const float* direction, const Points& g, const float* weight, const double* z,
                      const double* ramp, std::size_t thresholds, float* xi, double* above) {
  return HWY_DYNAMIC_DISPATCH(CountAbove)(direction, g, weight, z, ramp, thresholds, xi, above);
}

}  // namespace ltc::kernels
#endif
