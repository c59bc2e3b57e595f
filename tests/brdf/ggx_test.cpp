// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The GGX lobe against long double arithmetic, its identities and its own samplers.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "brdf/ggx.h"
#include "statistics.h"

namespace ltc {
namespace {

using test::ChiSquared;
using test::Uniform;

constexpr double kPi = std::numbers::pi;
constexpr double kGrazing = 0.9999 * kPi / 2;

using Vector3l = Eigen::Matrix<long double, 3, 1>;

// The corners that have broken other implementations: mirrors, needles and grazing views.
std::vector<Lobe> hard_lobes() {
  std::vector<Lobe> lobes;
  for (const double alpha_x : {1e-6, 1e-4, 0.02, 0.3, 1.0})
    for (const double alpha_y : {1e-6, 1e-4, 0.05, 1.0})
      for (const double theta : {0.0, 0.4, 1.2, 1.5, kGrazing})
        for (const double phi : {0.0, 0.7, kPi / 2})
          lobes.push_back({alpha_x, alpha_y, theta, phi});
  return lobes;
}

Eigen::Vector3d visible_normal(const GgxSampler& sampler, double u_azimuth, double u_height) {
  return sampler.visible_normal(std::cos(2 * kPi * u_azimuth), std::sin(2 * kPi * u_azimuth),
                                u_height);
}

TEST(Ggx, ViewAlongAnAxisIsExactlySymmetric) {
  EXPECT_EQ(Lobe({0.1, 0.1, 1.0, kPi / 2}).omega_v().x(), 0);
  EXPECT_EQ(Lobe({0.1, 0.1, 1.0, 0}).omega_v().y(), 0);
  EXPECT_EQ(Lobe({0.1, 0.1, 1.0, kPi}).omega_v().y(), 0);
  EXPECT_NE(Lobe({0.1, 0.1, 1.0, 1e-9}).omega_v().y(), 0);
}

TEST(Ggx, LambdaKeepsItsDigits) {
  // Equation (5) as printed, in long double; where it loses digits itself (t < 1e-6) its series.
  for (const double z : {1.0, 0.7, 0.1, 1.57e-4}) {
    for (const double alpha : {1e-6, 1e-3, 0.1, 1.0}) {
      const double sine = std::sqrt(1 - z * z);
      const long double t = static_cast<long double>(alpha * sine) * (alpha * sine) /
                            (static_cast<long double>(z) * z);
      const long double expected = t < 1e-6L ? t / 4 - t * t / 16 : (std::sqrt(1 + t) - 1) / 2;
      // 1e-12: the series leaves out t^3/32; the square root as printed loses 5e-20/1e-6.
      EXPECT_NEAR(ggx_lambda(alpha, alpha, {sine, 0, z}), static_cast<double>(expected),
                  1e-12 * static_cast<double>(expected));
    }
  }
}

TEST(Ggx, LambdaIsInfiniteAtTheHorizon) {
  EXPECT_TRUE(std::isinf(ggx_lambda(0.1, 0.1, {1, 0, 0})));
}

TEST(Ggx, ProjectedNormalDistributionIntegratesToOne) {
  // Midpoint rule in the slopes, r = t/(1 - t): smooth, so 1e-4 at 400 x 64 points is roomy.
  for (const auto& [alpha_x, alpha_y] : {std::pair{1e-6, 1e-6}, {0.3, 0.01}, {1.0, 1.0}}) {
    double sum = 0;
    const int radii = 400, angles = 64;
    for (int i = 0; i < radii; ++i) {
      const double t = (i + 0.5) / radii, r = t / (1 - t);
      for (int j = 0; j < angles; ++j) {
        const double psi = 2 * kPi * (j + 0.5) / angles;
        const Eigen::Vector3d slope(alpha_x * r * std::cos(psi), alpha_y * r * std::sin(psi), 1);
        const double z = 1 / slope.norm();
        sum += ggx_ndf(alpha_x, alpha_y, slope) * z * z * z * z * alpha_x * alpha_y * r /
               ((1 - t) * (1 - t));
      }
    }
    EXPECT_NEAR(sum * 2 * kPi / (radii * angles), 1, 1e-4);
  }
}

TEST(Ggx, BrdfIsEquationSixAndReciprocal) {
  Uniform uniform(11);
  auto direction = [&] {
    const double z = 0.02 + 0.98 * uniform(), azimuth = 2 * kPi * uniform();
    return std::pair(std::acos(z), azimuth);
  };
  for (int i = 0; i < 200; ++i) {
    const auto [theta_v, phi_v] = direction();
    const auto [theta_l, phi_l] = direction();
    const double alpha_x = 0.05 + uniform(), alpha_y = 0.05 + uniform();
    const Lobe there{alpha_x, alpha_y, theta_v, phi_v}, back{alpha_x, alpha_y, theta_l, phi_l};
    const Eigen::Vector3d v = there.omega_v(), l = back.omega_v();
    const Eigen::Vector3d h = (v + l).normalized();
    const double masking =
        1 / (1 + ggx_lambda(alpha_x, alpha_y, v) + ggx_lambda(alpha_x, alpha_y, l));
    const double as_printed = ggx_ndf(alpha_x, alpha_y, h) * masking / (4 * v.z());
    const double value = GgxSampler(there).brdf_cosine(l);
    EXPECT_NEAR(value, as_printed, 1e-12 * as_printed);  // rounding of well-conditioned terms
    EXPECT_NEAR(value * v.z(), GgxSampler(back).brdf_cosine(v) * l.z(), 1e-12 * value);
  }
}

TEST(Ggx, BrdfIsZeroBelowTheHorizon) {
  const GgxSampler sampler({0.5, 0.5, 1.0, 0.3});
  EXPECT_EQ(sampler.brdf_cosine(Eigen::Vector3d(0.6, 0, -0.8)), 0);
  EXPECT_EQ(sampler.brdf_cosine(Eigen::Vector3d(1, 0, 0)), 0);
  EXPECT_GT(sampler.densities(Eigen::Vector3d(-0.96, 0, -0.28)).sampling,
            0);  // light is lost there
  EXPECT_EQ(sampler.brdf_cosine(-sampler.omega_v()), 0);
}

TEST(Ggx, PeakOfASharpLobeIsFiniteAndRight) {
  for (const Lobe& lobe : hard_lobes()) {
    const GgxSampler sampler(lobe);
    // At the mirror direction h = z, D = 1/(pi ax ay), Lambda(l) = Lambda(v).
    const double lambda = ggx_lambda(lobe.alpha_x, lobe.alpha_y, sampler.omega_v());
    const double expected =
        1 / (kPi * lobe.alpha_x * lobe.alpha_y) / (1 + 2 * lambda) / (4 * sampler.omega_v().z());
    EXPECT_NEAR(sampler.brdf_cosine_at_offset(Eigen::Vector3d::Zero()), expected, 1e-12 * expected);
    EXPECT_NEAR(sampler.brdf_cosine(sampler.axis()), expected, 1e-12 * expected);
  }
}

// The reflection as everybody writes it, in long double.
Vector3l plain_offset(const Eigen::Vector3d& view, const Eigen::Vector3d& normal) {
  const Vector3l v = view.cast<long double>();
  const Vector3l h = normal.cast<long double>();
  const Vector3l mirror(-v.x(), -v.y(), v.z());
  return 2 * v.dot(h) * h - v - mirror;
}

TEST(Ggx, OffsetFromTheMirrorKeepsItsDigits) {
  Uniform uniform(5);
  for (const Lobe& lobe : hard_lobes()) {
    const GgxSampler sampler(lobe);
    for (int i = 0; i < 20; ++i) {
      // A slope whose z in long double makes the vector unit beyond double: the reference must not
      // suffer from the rounding of hz itself.
      const double u = uniform();
      const Eigen::Vector3d h = visible_normal(sampler, uniform(), u);
      Vector3l exact = h.cast<long double>();
      exact.z() = std::sqrt(1 - exact.x() * exact.x() - exact.y() * exact.y());
      if (exact.z() < 0.1L)
        continue;  // z follows from x and y well only away from the horizon
      const Vector3l v = sampler.omega_v().cast<long double>();
      const Vector3l offset = 2 * v.dot(exact) * exact - v - Vector3l(-v.x(), -v.y(), v.z());
      const double width = static_cast<double>(offset.norm());
      const LobeSample sample = sampler.reflect(h);
      // 1e-12 of the offset: a few roundings in double; 1e-19: the rounding of the reference.
      EXPECT_LT((sample.offset - offset.cast<double>()).norm(), 1e-12 * width + 1e-19);
    }
  }
}

TEST(Ggx, PlainReflectionWouldLoseDigits) {
  // Shows that the bound of the test above is one that arithmetic in double does not meet.
  const GgxSampler sampler({1e-6, 1e-6, 1.2, 0.7});
  const Eigen::Vector3d h = visible_normal(sampler, 0.3, 0.4);
  const Eigen::Vector3d v = sampler.omega_v();
  const Eigen::Vector3d careless = 2 * v.dot(h) * h - v - sampler.axis();
  const Eigen::Vector3d careful = sampler.reflect(h).offset;
  EXPECT_GT((careless - careful).norm(), 1e-12 * careful.norm());
  EXPECT_LT((plain_offset(v, h).cast<double>() - careful).norm(), 1e-6 * careful.norm());
}

TEST(Ggx, SamplesOfHardLobesAreFiniteUnitVectors) {
  const SampleLattice lattice(256);
  WeightedSamples samples;
  for (const Lobe& lobe : hard_lobes()) {
    const GgxSampler sampler(lobe);
    for (const double u_azimuth : {0.0, 0.25, 0.9999999})
      for (const double u_height : {0.0, 1e-16, 0.5, 1 - 0x1p-53}) {
        const LobeSample sample = sampler.sample(u_azimuth, u_height);
        EXPECT_NEAR(sample.omega_l.norm(), 1, 1e-14);
        EXPECT_GE(sample.v_dot_h, 0);
        EXPECT_TRUE(sample.weight >= 0 && sample.weight <= 1);
        EXPECT_TRUE(std::isfinite(sampler.brdf_cosine_at_offset(sample.offset)));
      }
    GgxSampler(lobe).sample_all(lattice, samples);
    EXPECT_TRUE(samples.offset.allFinite());
    EXPECT_TRUE(samples.weight.allFinite());
    EXPECT_GT(samples.weight.sum(), 0);
    Uniform uniform(3);
    for (int i = 0; i < 10; ++i)
      EXPECT_GT(sampler.sample_rejection(uniform).omega_l.z(), 0);
  }
}

TEST(Ggx, WeightIsBrdfOverDensity) {
  for (const Lobe& lobe : hard_lobes()) {
    const GgxSampler sampler(lobe);
    const LobeSample sample = sampler.sample(0.37, 0.41);
    const double density = sampler.densities_at_offset(sample.offset).sampling;
    EXPECT_NEAR(sample.weight, sampler.brdf_cosine_at_offset(sample.offset) / density, 1e-12);
  }
}

// Histograms over the slopes of the half vector in units of the roughness, which sharp and rough
// lobes fill alike: r = t/(1 - t), azimuth psi.
class SlopeHistogram {
 public:
  static constexpr int kRadii = 14, kAngles = 20, kSubdivisions = 12;

  explicit SlopeHistogram(const Lobe& lobe) : lobe_(lobe), sampler_(lobe) {}

  std::size_t bin(const Eigen::Vector3d& offset) const {
    const double hz = 2 * sampler_.omega_v().z() + offset.z();
    const double p = offset.x() / (lobe_.alpha_x * hz), q = offset.y() / (lobe_.alpha_y * hz);
    const double r = std::hypot(p, q);
    const double angle = std::atan2(q, p) / (2 * kPi);
    const int i = std::min(kRadii - 1, static_cast<int>(kRadii * r / (1 + r)));
    const int j = std::min(kAngles - 1, static_cast<int>(kAngles * (angle - std::floor(angle))));
    return static_cast<std::size_t>(i * kAngles + j);
  }

  // Integral over each bin of a density of light directions, given at offsets:
  // d omega_l = 4 (v.h) d omega_h, d omega_h = hz^3 alpha_x alpha_y dp dq.
  template <class Density>
  std::vector<double> integrate(Density&& density) const {
    std::vector<double> bins(kRadii * kAngles, 0.0);
    const int radii = kRadii * kSubdivisions, angles = kAngles * kSubdivisions;
    for (int i = 0; i < radii; ++i) {
      for (int j = 0; j < angles; ++j) {
        const double t = (i + 0.5) / radii, r = t / (1 - t);
        const double psi = 2 * kPi * (j + 0.5) / angles;
        const Eigen::Vector3d h =
            Eigen::Vector3d(lobe_.alpha_x * r * std::cos(psi), lobe_.alpha_y * r * std::sin(psi), 1)
                .normalized();
        const LobeSample sample = sampler_.reflect(h);
        if (sample.v_dot_h <= 0)
          continue;
        const double area = r / ((1 - t) * (1 - t)) * 2 * kPi / (radii * angles);
        bins[static_cast<std::size_t>(i / kSubdivisions * kAngles + j / kSubdivisions)] +=
            density(sample.offset) * 4 * sample.v_dot_h * std::pow(h.z(), 3) * lobe_.alpha_x *
            lobe_.alpha_y * area;
      }
    }
    return bins;
  }

 private:
  Lobe lobe_;
  GgxSampler sampler_;
};

std::vector<Lobe> lobes_of_chi_squared() {
  return {
      {1e-6, 1e-6, 1.2, 0.7}, {0.4, 0.05, 1.3, 0.9}, {0.9, 0.6, 0.5, 2.5}, {1e-4, 0.3, 1.5, 0.2}};
}

constexpr std::size_t kSamples = 400'000;

void scale(std::vector<double>& values, double factor) {
  for (double& value : values)
    value *= factor;
}

// How a sampler's histogram compares with the density of a lobe.
ChiSquared visible_normals_against(const Lobe& sampled, const Lobe& expected_lobe) {
  const SlopeHistogram histogram(sampled);
  const GgxSampler sampler(sampled), expected_sampler(expected_lobe);
  std::vector<double> expected = histogram.integrate([&](const Eigen::Vector3d& offset) {
    return expected_sampler.densities_at_offset(offset).sampling;
  });
  scale(expected, kSamples);
  std::vector<double> observed(expected.size(), 0.0);
  Uniform uniform(1);
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double u_azimuth = uniform();
    observed[histogram.bin(sampler.sample(u_azimuth, uniform()).offset)] += 1;
  }
  return test::chi_squared(observed, expected);
}

// A lobe whose density must be told from the given one's: 10 % rougher.
Lobe slightly_rougher(Lobe lobe) {
  lobe.alpha_x *= 1.1;
  return lobe;
}

TEST(GgxChiSquared, VisibleNormals) {
  for (const Lobe& lobe : lobes_of_chi_squared()) {
    const ChiSquared right = visible_normals_against(lobe, lobe);
    EXPECT_TRUE(right.accepted()) << right.deviations();
    EXPECT_GT(right.degrees_of_freedom, 50u);
    EXPECT_FALSE(visible_normals_against(lobe, slightly_rougher(lobe)).accepted());
  }
}

ChiSquared rejection_against(const Lobe& sampled, const Lobe& expected_lobe) {
  const SlopeHistogram histogram(sampled);
  const GgxSampler sampler(sampled), expected_sampler(expected_lobe);
  std::vector<double> expected = histogram.integrate([&](const Eigen::Vector3d& offset) {
    return expected_sampler.brdf_cosine_at_offset(offset);
  });
  double amplitude = 0;
  for (const double value : expected)
    amplitude += value;
  scale(expected, kSamples / amplitude);
  std::vector<double> observed(expected.size(), 0.0);
  Uniform uniform(2);
  for (std::size_t i = 0; i < kSamples; ++i)
    observed[histogram.bin(sampler.sample_rejection(uniform).offset)] += 1;
  return test::chi_squared(observed, expected);
}

TEST(GgxChiSquared, Rejection) {
  for (const Lobe& lobe : lobes_of_chi_squared()) {
    const ChiSquared right = rejection_against(lobe, lobe);
    EXPECT_TRUE(right.accepted()) << right.deviations();
    EXPECT_GT(right.degrees_of_freedom, 50u);
    EXPECT_FALSE(rejection_against(lobe, slightly_rougher(lobe)).accepted());
  }
}

// Sums of weights in [0, 1]; a lattice's are far less scattered than random ones, so the test is
// one-sided: too good is good.
ChiSquared lattice_against(const Lobe& sampled, const Lobe& expected_lobe) {
  const SlopeHistogram histogram(sampled);
  const GgxSampler expected_sampler(expected_lobe);
  std::vector<double> expected = histogram.integrate([&](const Eigen::Vector3d& offset) {
    return expected_sampler.brdf_cosine_at_offset(offset);
  });
  scale(expected, kSamples);
  std::vector<double> observed(expected.size(), 0.0);
  const SampleLattice lattice(kSamples);
  WeightedSamples samples;
  GgxSampler(sampled).sample_all(lattice, samples);
  for (Eigen::Index i = 0; i < samples.weight.size(); ++i)
    observed[histogram.bin(samples.offset.row(i).transpose())] += samples.weight[i];
  return test::chi_squared(observed, expected);
}

TEST(GgxChiSquared, WeightedLattice) {
  for (const Lobe& lobe : lobes_of_chi_squared()) {
    const ChiSquared right = lattice_against(lobe, lobe);
    EXPECT_TRUE(right.accepted()) << right.deviations();
    EXPECT_GT(right.degrees_of_freedom, 50u);
    EXPECT_FALSE(lattice_against(lobe, slightly_rougher(lobe)).accepted());
  }
}

}  // namespace
}  // namespace ltc
