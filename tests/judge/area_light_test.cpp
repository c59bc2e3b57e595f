// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/area_light.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/random.h"
#include "export/table_file.h"
#include "support/reference.h"
#include "support/refusal.h"
#include "table/lookup.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

const Lobe kRough{0.5, 0.2, 0.8, 0.6};

bool covers(const AreaLightJudge::Quad& quad, const Eigen::Vector3d& omega) {
  for (std::size_t i = 0; i < 4; ++i)
    if (quad[i].cross(quad[(i + 1) % 4]).dot(omega) <= 0)
      return false;
  return true;
}

TEST(AreaLight, FractionsAreThoseOfRejectionSampling) {
  AreaLightJudge judge;
  for (const Lobe& lobe : {kRough, Lobe{1, 1, 1.4, 0}, Lobe{0.02, 0.3, 0.3, 2}}) {
    judge.set_lobe(lobe);
    const GgxSampler sampler(lobe);
    Random random(1);
    constexpr int samples = 40000;
    std::vector<double> hits(judge.quads().size());
    for (int i = 0; i < samples; ++i) {
      const Eigen::Vector3d omega =
          sampler.sample_rejection([&] { return random.uniform(); }).omega_l;
      for (std::size_t quad = 0; quad < hits.size(); ++quad)
        hits[quad] += covers(judge.quads()[quad], omega);
    }
    for (std::size_t quad = 0; quad < hits.size(); ++quad) {
      const double p = judge.fractions()[quad];
      EXPECT_GT(p, 0.002);
      // 4.5 standard deviations of a binomial (192 of them: probability 1.3e-3 over all), and as
      // many of the judge's own noise.
      const double deviation = std::sqrt(p * (1 - p) / samples);
      EXPECT_NEAR(hits[quad] / samples, p, 4.5 * (deviation + 4e-4));
    }
  }
}

TEST(AreaLight, ALobeThatAnLtcCanBeHasNoError) {
  AreaLightJudge judge;
  // To first order in the roughness the closed form is GGX.
  const Lobe sharp{1e-3, 4e-4, 0.7, 0.4};
  judge.set_lobe(sharp);
  const Eigen::Matrix3d exact = testing::first_order_matrix(sharp);
  // The lobe's curvature is a share alpha of it; the mean of |noise| is below its deviation.
  EXPECT_LT(judge.error(exact).mean_absolute, judge.error(exact).standard_error + 1e-3);

  // And what is not that lobe has.
  for (int column = 0; column < 2; ++column) {
    Eigen::Matrix3d wider = exact;
    wider.col(column) *= 1.5;
    EXPECT_GT(judge.error(wider).mean_absolute, 0.01);
  }
  Eigen::Matrix3d tilted = exact;
  tilted.col(2) += 1e-3 * Eigen::Vector3d::UnitX();
  EXPECT_GT(judge.error(tilted).mean_absolute, 0.05);
}

TEST(AreaLight, ScaleAndMirrorsOfTheCosineChangeNothing) {
  AreaLightJudge judge;
  judge.set_lobe(kRough);
  const Eigen::Matrix3d matrix = testing::first_order_matrix(kRough);
  const double error = judge.error(matrix).mean_absolute;
  // Rounding of sums of 16 numbers about 0.1.
  EXPECT_NEAR(judge.error(17 * matrix).mean_absolute, error, 1e-12);
  Eigen::Matrix3d mirrored = matrix;
  mirrored.col(0) *= -1;
  EXPECT_LT(mirrored.determinant() * matrix.determinant(), 0);
  EXPECT_NEAR(judge.error(mirrored).mean_absolute, error, 1e-12);
}

TEST(AreaLight, TheStatedErrorOfTheSamplesIsTheirs) {
  AreaLightSettings few, many;
  few.samples = 2048;
  few.quads = many.quads = 200;
  many.samples = 1 << 17;
  AreaLightJudge coarse(few);
  const Eigen::Matrix3d matrix = testing::first_order_matrix(kRough);
  coarse.set_lobe(kRough);
  // The coarse judge's quads by many samples: a judge draws from its own samples, so integrate
  // over them here.
  const SampleLattice lattice(many.samples, 0.5, 0.5);
  WeightedSamples samples;
  GgxSampler(kRough).sample_all(lattice, samples);
  double squares = 0;
  for (std::size_t quad = 0; quad < few.quads; ++quad) {
    double inside = 0;
    for (Eigen::Index i = 0; i < samples.weight.size(); ++i)
      if (covers(coarse.quads()[quad], samples.axis + samples.offset.row(i).matrix().transpose()))
        inside += samples.weight[i];
    const double deviation = coarse.fractions()[quad] - inside / samples.weight.sum();
    squares += deviation * deviation;
  }
  const double measured = std::sqrt(squares / static_cast<double>(few.quads));
  // Two estimates of a root mean square over 200 quads that overlap.
  EXPECT_GT(measured, 0.6 * coarse.error(matrix).standard_error);
  EXPECT_LT(measured, 1.6 * coarse.error(matrix).standard_error);
}

TEST(AreaLight, TheAmplitudeCountsWhereItIsGiven) {
  AreaLightJudge judge;
  const Lobe sharp{1e-3, 4e-4, 0.7, 0.4};
  judge.set_lobe(sharp);
  const Eigen::Matrix3d matrix = testing::first_order_matrix(sharp);
  const AreaLightError own = judge.error(matrix), same = judge.error(matrix, judge.amplitude());
  EXPECT_EQ(own.mean_absolute, same.mean_absolute);
  EXPECT_EQ(own.largest, same.largest);
  EXPECT_GE(own.largest, own.mean_absolute);
  double mean_fraction = 0;
  for (const double fraction : judge.fractions())
    mean_fraction += fraction / static_cast<double>(judge.fractions().size());
  // A tenth too much light is a tenth of the light of each, but for the error that is there anyway.
  EXPECT_NEAR(judge.error(matrix, 1.1 * judge.amplitude()).mean_absolute, 0.1 * mean_fraction,
              own.mean_absolute);
}

TEST(AreaLight, ScaledLobesAreBrighterByTheirFactor) {
  const Lobe low{0.8, 0.3, 1.4, 0.5};
  AreaLightSettings settings;
  AreaLightJudge clipped(settings);
  settings.horizon = HorizonMode::scaled;
  AreaLightJudge scaled(settings);
  clipped.set_lobe(low);
  scaled.set_lobe(low);
  const Eigen::Matrix3d matrix = testing::first_order_matrix(low);
  for (const LtcLobe& ltc : {LtcLobe(matrix), LtcLobe(matrix, {-0.6, 0.3}, usual_creases)}) {
    const double factor = horizon_factor(ltc, HorizonMode::scaled);
    ASSERT_GT(factor, 1.03);
    // Rounding of sums of numbers about 0.1.
    EXPECT_NEAR(scaled.error(ltc).mean_absolute,
                clipped.error(ltc, factor * clipped.amplitude()).mean_absolute, 1e-12);
    EXPECT_GT(std::abs(scaled.error(ltc).mean_absolute - clipped.error(ltc).mean_absolute), 1e-3);
  }
}

TEST(AreaLight, TheSameLobeHasTheSameQuads) {
  AreaLightJudge judge, other;
  judge.set_lobe(kRough);
  other.set_lobe({1, 1, 1, 1});
  EXPECT_NE(judge.fractions(), other.fractions());
  other.set_lobe(kRough);
  EXPECT_EQ(judge.fractions(), other.fractions());
  AreaLightSettings settings;
  settings.seed += 7;
  AreaLightJudge third(settings);
  third.set_lobe(kRough);
  EXPECT_NE(judge.fractions(), third.fractions());
  third.set_lobe(kRough, 1);
  other.set_lobe(kRough, 1);
  EXPECT_NE(judge.fractions(), other.fractions());
  EXPECT_NE(third.fractions(), other.fractions());
}

TEST(AreaLight, AMatrixThatIsNoneHasNoError) {
  AreaLightJudge judge;
  judge.set_lobe(kRough);
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(1, 1) = 0;
  EXPECT_TRUE(std::isnan(judge.error(matrix).mean_absolute));
  matrix(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(judge.error(matrix).mean_absolute));
  EXPECT_TRUE(std::isnan(
      judge.error(Eigen::Matrix3d::Identity(), std::numeric_limits<double>::quiet_NaN()).largest));
}

TEST(AreaLight, RefusesSettingsOutOfRange) {
  AreaLightSettings settings;
  settings.quads = 0;
  test::expect_one_line(test::message_of<InputError>([&] { AreaLightJudge judge(settings); }),
                        {"0 quads", "at least 1"});
  settings = {};
  settings.samples = 63;
  test::expect_one_line(test::message_of<InputError>([&] { AreaLightJudge judge(settings); }),
                        {"63 samples", "at least 64"});
}

// The figure that tables are compared by: random queries as materials and views in use are.
TEST(AreaLight, ThePublishedTableErrsByTwoPercentOfTheLight) {
  const std::filesystem::path path = test::reference_file("upstream_alpha_lambda_theta_phi.npy");
  if (!std::filesystem::exists(path))
    GTEST_SKIP() << "no " << path << "; set LTCFIT_REFERENCE_DIR";
  const Table table = read_table(path);
  AreaLightSettings settings;
  settings.samples = 4096;
  AreaLightJudge judge(settings);
  Random random(7);
  constexpr int queries = 600;
  double mean = 0;
  for (int i = 0; i < queries; ++i) {
    const double root = 0.1 + 0.9 * random.uniform();
    const double alpha = root * root, lambda = random.uniform();
    const double theta = std::acos(random.uniform());
    const Lobe lobe{alpha, std::max(lambda * alpha, 1e-4), theta,
                    std::numbers::pi / 2 * random.uniform()};
    judge.set_lobe(lobe, static_cast<std::uint64_t>(i));
    mean += judge.error(look_up(table, lobe).matrix).mean_absolute / queries;
  }
  // 0.0230 with 16,384 samples. Another 600 queries differ by 0.0010, the standard error of their
  // mean; fewer samples add 0.0002.
  EXPECT_NEAR(mean, 0.0230, 0.0015);
}

}  // namespace
}  // namespace ltc
