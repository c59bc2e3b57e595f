// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The albedo integrals against finer and independent quadratures, in double.
#include "brdf/albedo.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "brdf/ggx.h"

namespace ltc {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kBound = 1e-4;  // what the table promises

Lobe paper_node(int alpha, int lambda, int theta, int phi) {
  return {std::max(alpha / 7.0, 1e-4), std::max(alpha / 7.0 * lambda / 7.0, 1e-4),
          0.9999 * kPi / 2 * theta / 7, kPi / 2 * phi / 7};
}

// Midpoint rule over the unit square of visible normals through the sampler's code: another
// rule, another precision. Its error is below 5e-6 (halving the steps changes it by less).
Albedo reference(const Lobe& lobe) {
  const GgxSampler sampler(lobe);
  const int azimuths = 384, heights = 1536;
  std::vector<double> cosines, sines;
  for (int i = 0; i < azimuths; ++i) {
    cosines.push_back(std::cos(2 * kPi * (i + 0.5) / azimuths));
    sines.push_back(std::sin(2 * kPi * (i + 0.5) / azimuths));
  }
  Albedo sum;
  for (int j = 0; j < heights; ++j) {
    for (int i = 0; i < azimuths; ++i) {
      // u = t^2 (3 - 2 t) crowds the points at both ends, where the integrand is steep.
      const double t = (j + 0.5) / heights;
      const LobeSample sample =
          sampler.reflect(sampler.visible_normal(cosines[i], sines[i], t * t * (3 - 2 * t)));
      const double weight = 6 * t * (1 - t) * sample.weight;
      sum.amplitude += weight;
      sum.fresnel += weight * std::pow(1 - sample.v_dot_h, 5);
    }
  }
  return {sum.amplitude / (azimuths * heights), sum.fresnel / (azimuths * heights)};
}

// Nodes where coarse rules err most (found once over all 4096), and the corners of the grid.
std::vector<Lobe> hard_nodes() {
  return {paper_node(1, 2, 1, 1), paper_node(1, 0, 6, 6), paper_node(2, 0, 4, 2),
          paper_node(2, 1, 1, 0), paper_node(3, 1, 1, 5), paper_node(5, 1, 5, 3),
          paper_node(6, 0, 1, 3), paper_node(7, 0, 2, 4), paper_node(7, 0, 2, 5),
          paper_node(4, 0, 6, 3), paper_node(0, 0, 0, 0), paper_node(0, 0, 7, 3),
          paper_node(7, 7, 7, 0), paper_node(7, 0, 7, 0), paper_node(7, 0, 7, 7),
          paper_node(1, 0, 7, 4), paper_node(7, 7, 0, 0), paper_node(1, 1, 6, 2)};
}

double largest_error(const Albedo& value, const Albedo& expected) {
  return std::max(std::abs(value.amplitude - expected.amplitude),
                  std::abs(value.fresnel - expected.fresnel));
}

TEST(Albedo, ConvergesBelowTheBound) {
  const AlbedoRule coarse(256), standard, fine(8 * AlbedoRule::default_points);
  double coarse_error = 0, standard_error = 0, fine_error = 0;
  for (const Lobe& lobe : hard_nodes()) {
    const Albedo expected = reference(lobe);
    coarse_error = std::max(coarse_error, largest_error(integrate_albedo(lobe, coarse), expected));
    standard_error =
        std::max(standard_error, largest_error(integrate_albedo(lobe, standard), expected));
    fine_error = std::max(fine_error, largest_error(integrate_albedo(lobe, fine), expected));
  }
  EXPECT_LT(standard_error, kBound);
  EXPECT_LT(fine_error, kBound / 5);    // 8 times the points: the two rules meet
  EXPECT_GT(coarse_error, 5 * kBound);  // so that the bound can be missed
}

TEST(Albedo, EqualsTheBrdfIntegratedOverTheHemisphere) {
  const AlbedoRule rule;
  for (const Lobe& lobe : {Lobe{1, 1, 0, 0}, Lobe{0.8, 0.4, 1.0, 0.6}, Lobe{0.5, 0.9, 0.5, 2.0}}) {
    const GgxSampler sampler(lobe);
    Albedo expected;
    const int steps = 500;
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; j < steps; ++j) {
        const double z = (i + 0.5) / steps, azimuth = 2 * kPi * (j + 0.5) / steps;
        const double sine = std::sqrt(1 - z * z);
        const Eigen::Vector3d l(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
        const double value = sampler.brdf_cosine(l) * 2 * kPi / (steps * steps);
        const double v_dot_h = sampler.omega_v().dot((sampler.omega_v() + l).normalized());
        expected.amplitude += value;
        expected.fresnel += value * std::pow(1 - v_dot_h, 5);
      }
    }
    EXPECT_LT(largest_error(integrate_albedo(lobe, rule), expected), kBound);
  }
}

TEST(Albedo, OfAMirrorIsOneAndSchlick) {
  const AlbedoRule rule;
  for (const double theta : {0.0, 0.5, 1.2, 1.5}) {
    for (const double alpha : {1e-6, 1e-4}) {
      const Albedo albedo = integrate_albedo({alpha, alpha, theta, 0.3}, rule);
      // The lobe's tails, of weight alpha^2 and first-order change alpha; and rounding in float.
      EXPECT_NEAR(albedo.amplitude, 1, 1e-5);
      EXPECT_NEAR(albedo.fresnel, std::pow(1 - std::cos(theta), 5), 1e-5);
    }
  }
}

TEST(Albedo, IsFiniteAndOrderedAtEveryCorner) {
  const AlbedoRule rule(1024);
  for (const double alpha_x : {1e-6, 1e-4, 0.1, 1.0})
    for (const double alpha_y : {1e-6, 1e-4, 0.1, 1.0})
      for (const double theta : {0.0, 1.0, 1.5, 0.9999 * kPi / 2})
        for (const double phi : {0.0, 0.8, kPi / 2}) {
          const Albedo albedo = integrate_albedo({alpha_x, alpha_y, theta, phi}, rule);
          EXPECT_GT(albedo.amplitude, 0);
          EXPECT_LT(albedo.amplitude, 1 + 1e-5);  // rounding of the weights in float
          EXPECT_GE(albedo.fresnel, 0);
          EXPECT_LE(albedo.fresnel, albedo.amplitude);
        }
}

TEST(Albedo, HasTheSameBitsOnEveryInstructionSet) {
  const AlbedoRule rule(1024);
  const Lobe lobe{0.4, 0.1, 1.3, 0.5};
  const Albedo expected = integrate_albedo(lobe, rule);
  int targets = 0;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    const Albedo albedo = integrate_albedo(lobe, rule);
    EXPECT_EQ(albedo.amplitude, expected.amplitude) << hwy::TargetName(target);
    EXPECT_EQ(albedo.fresnel, expected.fresnel) << hwy::TargetName(target);
    ++targets;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_GE(targets, 1);
}

}  // namespace
}  // namespace ltc
