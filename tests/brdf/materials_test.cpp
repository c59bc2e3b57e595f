// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What every lobe model owes: samples that follow its density, weights that are its BRDF,
// reciprocity, the symmetries of tables, albedos.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "brdf/albedo.h"
#include "brdf/beckmann.h"
#include "brdf/charlie.h"
#include "brdf/lobe_model.h"
#include "core/error.h"
#include "statistics.h"
#include "support/refusal.h"

namespace ltc {
namespace {

using test::ChiSquared;
using test::Uniform;

constexpr double kPi = std::numbers::pi;

// A model's lobes, wide enough for bins of the hemisphere.
struct Case {
  std::string name;
  std::vector<Lobe> lobes;
};
void PrintTo(const Case& one, std::ostream* out) {
  *out << one.name;
}

Case beckmann_lobes() {
  const LobeModel* const model = &beckmann();
  return {"beckmann",
          {{0.9, 0.6, 0.5, 2.5, model},
           {0.4, 0.15, 1.3, 0.9, model},
           {0.2, 0.5, 1.5, 4.0, model},
           {0.3, 0.3, 0, 0, model}}};
}
Case sheen_lobes(SheenVisibility visibility) {
  const LobeModel* const model = &charlie(visibility);
  return {visibility == SheenVisibility::charlie ? "charlie" : "ashikhmin",
          {{1, 1, 0.3, 0.4, model},
           {0.25, 0.25, 1.2, 2.0, model},
           {0.05, 0.05, 0, 0, model},
           {0.05, 0.05, 1.56, 5.0, model}}};
}

class Materials : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(, Materials,
                         testing::Values(beckmann_lobes(), sheen_lobes(SheenVisibility::charlie),
                                         sheen_lobes(SheenVisibility::ashikhmin)),
                         [](const auto& info) { return info.param.name; });

// Histograms over the hemisphere: the square root of the height, for what is at the horizon, and
// the azimuth. All below the horizon is one bin.
class HemisphereHistogram {
 public:
  static constexpr int kHeights = 12, kAzimuths = 16, kSubdivisions = 64;
  static constexpr std::size_t kBelow = kHeights * kAzimuths;

  static std::size_t bin(const Eigen::Vector3d& omega) {
    if (!(omega.z() > 0))
      return kBelow;
    const double turns = std::atan2(omega.y(), omega.x()) / (2 * kPi);
    const int i = std::min(kHeights - 1, static_cast<int>(kHeights * std::sqrt(omega.z())));
    const int j =
        std::min(kAzimuths - 1, static_cast<int>(kAzimuths * (turns - std::floor(turns))));
    return static_cast<std::size_t>(i * kAzimuths + j);
  }

  // Of each bin above the horizon the integral of a density, by the midpoint rule.
  template <class Density>
  static std::vector<double> integrate(Density&& density) {
    std::vector<double> bins(kBelow + 1, 0.0);
    const int heights = kHeights * kSubdivisions, azimuths = kAzimuths * kSubdivisions;
    for (int i = 0; i < heights; ++i)
      for (int j = 0; j < azimuths; ++j) {
        const double root = (i + 0.5) / heights, z = root * root;
        const double azimuth = 2 * kPi * (j + 0.5) / azimuths, sine = std::sqrt(1 - z * z);
        const Eigen::Vector3d omega(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
        bins[bin(omega)] += density(omega) * 2 * root * 2 * kPi / (heights * azimuths);
      }
    return bins;
  }
};

constexpr std::size_t kSamples = 200'000;

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values)
    sum += value;
  return sum;
}

// Of samples as they come, and of those that a weighted rejection leaves.
enum class Kept { all, by_weight };
ChiSquared samples_against(const Lobe& sampled, const Lobe& expected_lobe, Kept kept) {
  const auto sampler = sampled.model->sampler(sampled);
  const auto other = expected_lobe.model->sampler(expected_lobe);
  std::vector<double> expected = HemisphereHistogram::integrate([&](const Eigen::Vector3d& omega) {
    const LobeDensities densities = other->densities(omega);
    return kept == Kept::all ? densities.sampling : densities.brdf_cosine;
  });
  // Sheen is sampled above the horizon alone.
  if (kept == Kept::all && sampled.model->about_mirror())
    expected[HemisphereHistogram::kBelow] = std::max(0.0, 1 - sum_of(expected));
  const double total = sum_of(expected);
  for (double& value : expected)
    value *= kSamples / total;
  std::vector<double> observed(expected.size(), 0.0);
  Uniform uniform(17);
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double azimuth = uniform();
    observed[HemisphereHistogram::bin(kept == Kept::all
                                          ? sampler->sample(azimuth, uniform()).omega_l
                                          : sampler->sample_rejection(uniform).omega_l)] += 1;
  }
  return test::chi_squared(observed, expected);
}

// Another lobe, whose density must be told from the given one's.
Lobe another(Lobe lobe) {
  lobe.alpha_x *= 0.8;
  lobe.alpha_y *= 0.8;
  return lobe;
}

TEST_P(Materials, SamplesFollowTheirDensity) {
  for (const Lobe& lobe : GetParam().lobes) {
    const ChiSquared right = samples_against(lobe, lobe, Kept::all);
    EXPECT_TRUE(right.accepted()) << right.deviations();
    EXPECT_GT(right.degrees_of_freedom, 30u);
    EXPECT_FALSE(samples_against(lobe, another(lobe), Kept::all).accepted());
  }
}

TEST_P(Materials, RejectionFollowsTheBrdf) {
  for (const Lobe& lobe : GetParam().lobes) {
    const ChiSquared right = samples_against(lobe, lobe, Kept::by_weight);
    EXPECT_TRUE(right.accepted()) << right.deviations();
    EXPECT_GT(right.degrees_of_freedom, 30u);
    EXPECT_FALSE(samples_against(lobe, another(lobe), Kept::by_weight).accepted());
  }
}

TEST_P(Materials, WeightsAreTheBrdfOverTheDensityAndBounded) {
  Uniform uniform(5);
  for (const Lobe& lobe : GetParam().lobes) {
    const auto sampler = lobe.model->sampler(lobe);
    for (int i = 0; i < 2000; ++i) {
      const double azimuth = uniform();
      const LobeSample sample = sampler->sample(azimuth, uniform());
      const LobeDensities densities = sampler->densities_at_offset(sample.offset);
      // Rounding, of directions near the horizon above all.
      EXPECT_NEAR(sample.weight * densities.sampling, densities.brdf_cosine,
                  1e-9 * densities.sampling);
      EXPECT_GE(sample.weight, 0);
      EXPECT_LE(sample.weight, sampler->most_weight());
      EXPECT_NEAR(sample.omega_l.norm(), 1, 1e-12);
      EXPECT_NEAR((sampler->axis() + sample.offset - sample.omega_l).norm(), 0, 1e-12);
      const Eigen::Vector3d half = (sampler->omega_v() + sample.omega_l).normalized();
      EXPECT_NEAR(sample.v_dot_h, sampler->omega_v().dot(half), 1e-9);
    }
  }
}

TEST_P(Materials, ViewAndLightMayBeExchanged) {
  Uniform uniform(7);
  for (const Lobe& lobe : GetParam().lobes)
    for (int i = 0; i < 100; ++i) {
      Lobe back = lobe;
      back.theta_radians = std::acos(0.01 + 0.99 * uniform());
      back.phi_radians = 2 * kPi * uniform();
      const Eigen::Vector3d v = lobe.omega_v(), l = back.omega_v();
      const double there = lobe.model->sampler(lobe)->brdf_cosine(l) * v.z();
      EXPECT_NEAR(lobe.model->sampler(back)->brdf_cosine(v) * l.z(), there, 1e-11 * there);
    }
}

// Lobes are mirrored with the view in the planes of x and y, and exchanged with the axes.
TEST_P(Materials, HaveTheSymmetriesOfTables) {
  Uniform uniform(9);
  for (const Lobe& lobe : GetParam().lobes) {
    const auto sampler = lobe.model->sampler(lobe);
    Lobe mirrored = lobe, swapped = lobe;
    mirrored.phi_radians = kPi - lobe.phi_radians;
    swapped.phi_radians = kPi / 2 - lobe.phi_radians;
    std::swap(swapped.alpha_x, swapped.alpha_y);
    for (int i = 0; i < 50; ++i) {
      const double z = uniform(), azimuth = 2 * kPi * uniform(), sine = std::sqrt(1 - z * z);
      const Eigen::Vector3d l(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
      const double value = sampler->brdf_cosine(l);
      EXPECT_NEAR(lobe.model->sampler(mirrored)->brdf_cosine({-l.x(), l.y(), z}), value,
                  1e-11 * value);
      EXPECT_NEAR(lobe.model->sampler(swapped)->brdf_cosine({l.y(), l.x(), z}), value,
                  1e-11 * value);
    }
  }
}

TEST_P(Materials, AlbedosAreTheBrdfIntegratedOverTheHemisphere) {
  const AlbedoRule rule, coarse(64);
  double coarse_error = 0;
  for (const Lobe& lobe : GetParam().lobes) {
    const auto sampler = lobe.model->sampler(lobe);
    double amplitude = 0, fresnel = 0;
    const int steps = 1500;
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j) {
        const double root = (i + 0.5) / steps, z = root * root;
        const double azimuth = 2 * kPi * (j + 0.5) / steps, sine = std::sqrt(1 - z * z);
        const Eigen::Vector3d l(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
        const double value = sampler->brdf_cosine(l) * 2 * root * 2 * kPi / (steps * steps);
        amplitude += value;
        const double v_dot_h = sampler->omega_v().dot((sampler->omega_v() + l).normalized());
        fresnel += value * std::pow(1 - v_dot_h, 5);
      }
    const Albedo albedo = integrate_albedo(lobe, rule);
    EXPECT_NEAR(albedo.amplitude, amplitude, 1e-4);  // what a table promises
    EXPECT_NEAR(albedo.fresnel, fresnel, 1e-4);
    EXPECT_GT(albedo.amplitude, 0);
    coarse_error =
        std::max(coarse_error, std::abs(integrate_albedo(lobe, coarse).amplitude - amplitude));
  }
  EXPECT_GT(coarse_error, 1e-4);  // so that the bound can be missed
}

TEST(Beckmann, LambdaKeepsItsDigits) {
  for (const double alpha : {1e-6, 0.05, 0.3, 1.0})
    for (const double z : {1.0, 0.7, 0.3, 0.05, 1.57e-4}) {
      const double sine = std::sqrt(1 - z * z);
      if (sine == 0)
        continue;
      const long double a = static_cast<long double>(z) / (static_cast<long double>(alpha) * sine);
      const long double expected =
          (std::exp(-a * a) / (a * std::sqrt(std::numbers::pi_v<long double>)) - std::erfc(a)) / 2;
      const double value = beckmann_lambda(alpha, alpha, {sine, 0, z});
      // The two terms agree to 1/(2 a^2): where it is tiny, 1 + Lambda asks for nothing of it.
      const double room = 1e-15 + 1e-14 * static_cast<double>(expected * (1 + a * a));
      EXPECT_NEAR(value, static_cast<double>(expected), room) << alpha << " " << z;
    }
  EXPECT_EQ(beckmann_lambda(0.5, 0.5, {0, 0, 1}), 0);
  EXPECT_TRUE(std::isinf(beckmann_lambda(0.5, 0.5, {1, 0, 0})));
}

TEST(Beckmann, ProjectedNormalDistributionIntegratesToOne) {
  for (const auto& [alpha_x, alpha_y] : {std::pair{1e-6, 1e-6}, {0.3, 0.01}, {1.0, 1.0}}) {
    double sum = 0;
    const int radii = 2000, angles = 32;
    const double furthest = 6;
    for (int i = 0; i < radii; ++i)
      for (int j = 0; j < angles; ++j) {
        const double r = furthest * (i + 0.5) / radii, psi = 2 * kPi * (j + 0.5) / angles;
        const Eigen::Vector3d slope(alpha_x * r * std::cos(psi), alpha_y * r * std::sin(psi), 1);
        sum += beckmann_ndf(alpha_x, alpha_y, slope) * std::pow(slope.norm(), -4) * r;
      }
    // The midpoint rule's own error is of the order of the step's square, 9e-6/24.
    EXPECT_NEAR(sum * alpha_x * alpha_y * 2 * kPi / angles * furthest / radii, 1, 1e-5);
  }
}

// The map of a sampler against the masses integrated step by step.
TEST(Beckmann, VisibleSlopesHaveTheirMass) {
  for (const double theta : {0.0, 0.4, 1.2, 1.5, 0.9999 * kPi / 2})
    for (const double alpha : {1e-3, 0.3, 1.0}) {
      const Lobe lobe{alpha, alpha, theta, 0.3, &beckmann()};
      const BeckmannSampler sampler(lobe);
      const double s = alpha * std::sin(theta), c = std::cos(theta);
      const double least = s > 0 ? std::max(-c / s, -7.0) : -7.0, step = 1e-4;
      const auto density = [&](double x) { return std::max(0.0, c + s * x) * std::exp(-x * x); };
      double total = 0;
      for (double x = least + step / 2; x < 7; x += step)
        total += density(x) * step;
      double below = 0, x = least;
      for (const double normal : {-2.5, -1.1, -0.2, 0.0, 0.55, 1.9, 3.1}) {
        const double slope = sampler.visible_slope(normal);
        for (; x + step < slope; x += step)
          below += density(x + step / 2) * step;
        const double mass = below + density((x + slope) / 2) * (slope - x);
        // The integration by steps is good to 1e-9; 1e-8 is what the map promises.
        EXPECT_NEAR(mass / total, std::erfc(-normal) / 2, 2e-8) << theta << " " << alpha;
      }
    }
}

TEST(Beckmann, SamplesAreFiniteAtEveryCorner) {
  for (const double alpha_x : {1e-6, 1e-4, 0.02, 1.0})
    for (const double alpha_y : {1e-6, 0.05, 1.0})
      for (const double theta : {0.0, 1.2, 1.5, 0.9999 * kPi / 2})
        for (const double phi : {0.0, 0.7, kPi / 2}) {
          const Lobe lobe{alpha_x, alpha_y, theta, phi, &beckmann()};
          const BeckmannSampler sampler(lobe);
          for (const double u_azimuth : {0.0, 0.3, 0.5, 0.999999})
            for (const double u_height : {0.0, 1e-9, 0.5, 1 - 1e-9, 1 - 0x1p-53, 1.0}) {
              const LobeSample sample = sampler.sample(u_azimuth, u_height);
              EXPECT_TRUE(sample.offset.allFinite());
              EXPECT_TRUE(sample.weight >= 0 && sample.weight <= 1);
              EXPECT_NEAR(sample.omega_l.norm(), 1, 1e-9);
              EXPECT_TRUE(std::isfinite(sampler.brdf_cosine_at_offset(sample.offset)));
            }
          // Nothing is left out near the mirror direction, however sharp: h = z there.
          EXPECT_NEAR(sampler.brdf_cosine_at_offset(Eigen::Vector3d::Zero()),
                      1 / (kPi * alpha_x * alpha_y * 4) /
                          (std::cos(theta) *
                           (1 + 2 * beckmann_lambda(alpha_x, alpha_y, sampler.omega_v()))),
                      1e-9 / (alpha_x * alpha_y));
        }
}

TEST(Charlie, IsThePapersFormula) {
  // Worked out with the paper's numbers at alpha = 0.25, cos(theta_v) = 0.6 and cos(theta_l) = 0.3
  // across a quarter turn.
  const Lobe lobe{0.25, 0.25, std::acos(0.6), 0, &charlie()};
  const Eigen::Vector3d v(0.8, 0, 0.6), l(0, std::sqrt(1 - 0.09), 0.3);
  const double cosine = (v + l).normalized().z();
  const double ndf = (2 + 4.0) * std::pow(1 - cosine * cosine, 2) / (2 * kPi);
  const auto fitted = [](double x) {
    const double t = 0.75 * 0.75;  // of the numbers of alpha = 0
    const double a = 21.5473 + t * (25.3245 - 21.5473), b = 3.82987 + t * (3.32435 - 3.82987);
    const double c = 0.19823 + t * (0.16801 - 0.19823), d = -1.97760 + t * (-1.27393 + 1.97760);
    return a / (1 + b * std::pow(x, c)) + d * x - 4.32054 + t * (-4.85967 + 4.32054);
  };
  const double lambda_v = std::exp(2 * fitted(0.5) - fitted(0.4)), lambda_l = std::exp(fitted(0.3));
  EXPECT_NEAR(CharlieSampler(lobe, SheenVisibility::charlie).brdf_cosine(l),
              ndf / ((1 + lambda_v + lambda_l) * 4 * 0.6), 1e-12);
  EXPECT_NEAR(CharlieSampler(lobe, SheenVisibility::ashikhmin).brdf_cosine(l),
              ndf * 0.3 / (4 * (0.6 + 0.3 - 0.18)), 1e-12);
}

TEST(Charlie, RefusesWhatItHasNot) {
  const LobeModel& sheen = charlie();
  const std::string two = test::message_of<InputError>([&] {
    sheen.require({0.5, 0.25, 0.3, 0, &sheen});
  });
  test::expect_one_line(two, {"charlie", "0.5", "0.25", "isotropic"});
  const std::string smooth = test::message_of<InputError>([&] {
    sheen.sampler({1e-4, 1e-4, 0.3, 0, &sheen});
  });
  test::expect_one_line(smooth, {"charlie", "0.0001", "0.001"});
}

}  // namespace
}  // namespace ltc
