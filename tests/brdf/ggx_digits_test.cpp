// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The GGX lobe against its formulas as printed, evaluated with 38 digits, over roughnesses of 1e-6
// to 1 and views up to 89.999 degrees; and what those formulas give in double.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <numbers>
#include <type_traits>

#include "brdf/albedo.h"
#include "brdf/ggx.h"
#include "core/angle.h"
#include "support/wide.h"

namespace ltc {
namespace {

using test::kDoubleRounding;
using test::kFloatRounding;
using test::logarithmic;
using test::Wide;
using test::WorstError;

constexpr double kPi = std::numbers::pi;

// The least slopes of a view, and the largest ones.
std::vector<double> thetas() {
  std::vector<double> thetas = {0, 0.3, 0.8, 1.2};
  for (const double theta : logarithmic(1e-6, 0.1, 6)) {
    thetas.push_back(theta);
    thetas.push_back(kPi / 2 - std::max(theta, radians_of_degrees(0.001)));
  }
  return thetas;
}

std::vector<Lobe> lobes() {
  std::vector<Lobe> lobes;
  for (const double alpha_x : logarithmic(1e-6, 1, 4))
    for (const double alpha_y : logarithmic(1e-6, 1, 4))
      for (const double theta : thetas())
        for (const double phi : {0.0, 1e-6, 0.7, kPi / 2})
          lobes.push_back({alpha_x, alpha_y, theta, phi});
  return lobes;
}

Eigen::Vector3d visible_normal(const GgxSampler& sampler, double u_azimuth, double u_height) {
  return sampler.visible_normal(std::cos(2 * kPi * u_azimuth), std::sin(2 * kPi * u_azimuth),
                                u_height);
}

Wide square(const Wide& x) {
  return x * x;
}

TEST(GgxDigits, CosineOfAGrazingView) {
  WorstError careful, naive;
  for (const double theta : thetas()) {
    const long double expected = std::cos(static_cast<long double>(theta));
    const Eigen::Vector3d v = Lobe{1, 1, theta, 0}.omega_v();
    careful.add_relative(v.z(), expected);
    naive.add_relative(std::sqrt(1 - v.x() * v.x()), expected);
  }
  // One rounding of the library's cosine.
  test::expect_only_the_careful_one_within(2 * kDoubleRounding, careful, naive);
}

TEST(GgxDigits, Lambda) {
  WorstError careful, naive;
  for (const Lobe& lobe : lobes()) {
    const Eigen::Vector3d v = lobe.omega_v();
    const Wide z = v.z();
    const Wide tangents =
        (square(Wide(lobe.alpha_x) * v.x()) + square(Wide(lobe.alpha_y) * v.y())) / square(z);
    const Wide expected = (sqrt(Wide(1) + tangents) - Wide(1)) / Wide(2);
    if (static_cast<double>(expected) == 0)
      continue;
    careful.add_relative(ggx_lambda(lobe.alpha_x, lobe.alpha_y, v), expected);
    const double t = (std::pow(lobe.alpha_x * v.x(), 2) + std::pow(lobe.alpha_y * v.y(), 2)) /
                     std::pow(v.z(), 2);
    naive.add_relative((-1 + std::sqrt(1 + t)) / 2, expected);
  }
  // Some ten roundings of terms that are all positive.
  test::expect_only_the_careful_one_within(8 * kDoubleRounding, careful, naive);
}

// Slopes of visible normals, in units of the roughness, towards the rim of the cap: those of the
// tails.
TEST(GgxDigits, VisibleNormalsOfTheTails) {
  WorstError careful, naive;
  for (const double alpha : logarithmic(1e-6, 1, 7))
    for (const double theta : thetas())
      for (const double from_rim : logarithmic(1e-15, 0.999, 31)) {
        const Lobe lobe{alpha, alpha, theta, 0};
        const double u = 1 - from_rim;
        const Eigen::Vector3d h = GgxSampler(lobe).visible_normal(0, 1, u);  // across the view
        const Eigen::Vector3d v = lobe.omega_v();
        const Wide x = Wide(alpha) * v.x(), length = sqrt(square(x) + square(Wide(v.z())));
        const Wide cap_z = Wide(v.z()) / length;
        const Wide c_z = (Wide(1) - u) * (Wide(1) + cap_z) - cap_z;
        const Wide expected = sqrt(Wide(1) - square(c_z)) / (c_z + cap_z);
        careful.add_relative(h.y() / (alpha * h.z()), expected);
        const double z = v.z() / std::hypot(alpha * v.x(), v.z());
        const double naive_c_z = (1 - u) * (1 + z) - z;
        naive.add_relative(std::sqrt(std::max(0.0, 1 - naive_c_z * naive_c_z)) / (naive_c_z + z),
                           expected);
      }
  // Some twenty roundings, and no subtraction but 1 - u, which is exact.
  test::expect_only_the_careful_one_within(16 * kDoubleRounding, careful, naive);
}

TEST(GgxDigits, OffsetsFromTheMirrorDirection) {
  WorstError careful, naive;
  for (const Lobe& lobe : lobes()) {
    const GgxSampler sampler(lobe);
    for (const double u : {0.01, 0.3, 0.9}) {
      const Eigen::Vector3d h = visible_normal(sampler, 0.15, u);
      if (h.z() < 0.1)
        continue;  // z follows from x and y well only away from the horizon
      const Eigen::Vector3d v = sampler.omega_v();
      const Wide hx = h.x(), hy = h.y(), hz = sqrt(Wide(1) - square(hx) - square(hy));
      const Wide dot = Wide(v.x()) * hx + Wide(v.y()) * hy + Wide(v.z()) * hz;
      const Wide offset[3] = {Wide(2) * dot * hx, Wide(2) * dot * hy,
                              Wide(2) * dot * hz - Wide(v.z()) - Wide(v.z())};
      const auto error = [&](const Eigen::Vector3d& found) {
        Eigen::Vector3d difference, expected;
        for (int i = 0; i < 3; ++i) {
          difference[i] = static_cast<double>(Wide(found[i]) - offset[i]);
          expected[i] = static_cast<double>(offset[i]);
        }
        return difference.norm() / expected.norm();
      };
      careful.add(error(sampler.reflect(h).offset));
      naive.add(error(2 * v.dot(h) * h - v - sampler.axis()));
    }
  }
  // Some thirty roundings. Measured: 10.
  test::expect_only_the_careful_one_within(32 * kDoubleRounding, careful, naive);
}

TEST(GgxDigits, DensityBesideTheMirrorDirection) {
  WorstError careful, naive;
  for (const double alpha : logarithmic(1e-6, 1e-2, 5))
    for (const double theta : {0.0, 0.3, 0.8, 1.2, 1.5}) {
      const Lobe lobe{alpha, alpha, theta, 0.4};
      const GgxSampler sampler(lobe);
      const LobeSample sample = sampler.sample(0.3, 0.6);
      const Eigen::Vector3d v = sampler.omega_v();
      // D of the half vector in its slopes, which is as printed in equation (4).
      const Wide hx = sample.offset.x(), hy = sample.offset.y();
      const Wide hz = Wide(v.z()) + v.z() + sample.offset.z();
      const Wide squared = square(hx) + square(hy) + square(hz);
      const Wide stretched =
          (square(hx / Wide(alpha)) + square(hy / Wide(alpha)) + square(hz)) / squared;
      const Wide expected = Wide(1) / (Wide(kPi) * Wide(alpha) * alpha * square(stretched));
      const double d = ggx_ndf(
          alpha, alpha, {sample.offset.x(), sample.offset.y(), 2 * v.z() + sample.offset.z()});
      careful.add_relative(d, expected);
      naive.add_relative(ggx_ndf(alpha, alpha, (v + sample.omega_l).normalized()), expected);
    }
  // Some ten roundings, four of them squared twice.
  test::expect_only_the_careful_one_within(32 * kDoubleRounding, careful, naive);
}

// The integrals of the rule's own points by the formulas as printed; in single precision, with z of
// the light from its x and y.
template <typename Scalar>
Albedo plain_albedo(const Lobe& lobe, const AlbedoRule& rule) {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  const Vector v = lobe.omega_v().cast<Scalar>();
  const auto ax = static_cast<Scalar>(lobe.alpha_x), ay = static_cast<Scalar>(lobe.alpha_y);
  const Vector stretched = Vector(ax * v.x(), ay * v.y(), v.z()).normalized();
  const auto lambda = [&](const Vector& w) {
    const Scalar s2 = ax * ax * w.x() * w.x() + ay * ay * w.y() * w.y();
    return (std::sqrt(1 + s2 / (w.z() * w.z())) - 1) / 2;
  };
  Scalar amplitude = 0, fresnel = 0;
  for (std::size_t i = 0; i < rule.size(); ++i) {
    // The height that is stored nearer to zero has the digits.
    const Scalar above = rule.height[i] < 0.5f ? 1 - static_cast<Scalar>(rule.height[i])
                                               : static_cast<Scalar>(rule.one_minus_height[i]);
    const Scalar c_z = above * (1 + stretched.z()) - stretched.z();
    const Scalar sine = std::sqrt(std::max(Scalar(0), (1 - c_z) * (1 + c_z)));
    const Vector h = Vector(ax * (sine * rule.cos_azimuth[i] + stretched.x()),
                            ay * (sine * rule.sin_azimuth[i] + stretched.y()), c_z + stretched.z())
                         .normalized();
    const Scalar dot = v.dot(h);
    Vector l = 2 * dot * h - v;
    if (!(l.z() > 0))
      continue;
    if (std::is_same_v<Scalar, float>)
      l.z() = std::sqrt(std::max(Scalar(0), 1 - l.x() * l.x() - l.y() * l.y()));
    const Scalar weight = rule.weight[i] * (1 + lambda(v)) / (1 + lambda(v) + lambda(l));
    amplitude += weight;
    fresnel += weight * std::pow(1 - dot, Scalar(5));
  }
  return {static_cast<double>(amplitude), static_cast<double>(fresnel)};
}

TEST(GgxDigits, AlbedoInSinglePrecision) {
  const AlbedoRule rule;
  WorstError careful, naive;
  for (const double alpha_x : logarithmic(1e-6, 1, 3))
    for (const double alpha_y : logarithmic(1e-6, 1, 3))
      for (const double theta : {0.0, 1e-3, 0.8, 1.5, radians_of_degrees(89.999)}) {
        const Lobe lobe{alpha_x, alpha_y, theta, 0.7};
        const Albedo expected = plain_albedo<long double>(lobe, rule);
        const Albedo plain = plain_albedo<float>(lobe, rule);
        const Albedo found = integrate_albedo(lobe, rule);
        careful.add(found.amplitude - expected.amplitude);
        careful.add(found.fresnel - expected.fresnel);
        naive.add(plain.amplitude - expected.amplitude);
      }
  // Absolute, of integrals up to 1: a tenth of what the quadrature is tested for, and most of it
  // the rounding of the view direction and of the roughness. Measured: 43.
  test::expect_only_the_careful_one_within(128 * kFloatRounding, careful, naive);
}

}  // namespace
}  // namespace ltc
