// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Distributions along a direction in closed form: against samples, finite differences, the sorted
// loss, and themselves where two formulas meet.
#include "fit/arc_model.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "fit/lobes.h"
#include "fit/starting_points.h"
#include "judge/held_out.h"

namespace ltc {
namespace {

using kernels::arc_lanes;
using kernels::ArcDistributions;
using kernels::ArcNodes;

Eigen::Vector3d random_direction(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

// An LTC as tables have them: a diagonal, turned and sheared by a little.
std::array<double, 9> random_map(Random& random, double alpha, double lambda) {
  const double scale[3] = {alpha, alpha * lambda, 1};
  std::array<double, 9> w;
  for (std::size_t i = 0; i < 9; ++i)
    w[i] = ((i % 4 == 0) + 0.2 * random.normal()) * scale[i % 3];
  return w;
}

Eigen::Vector3d mapped(const std::array<double, 9>& w, const Eigen::Vector3d& a) {
  return {w[0] * a.x() + w[1] * a.y() + w[2] * a.z(), w[3] * a.x() + w[4] * a.y() + w[5] * a.z(),
          w[6] * a.x() + w[7] * a.y() + w[8] * a.z()};
}

// As many pairs as there are lanes, thresholds about the lobe.
struct Pairs {
  alignas(64) double dx[arc_lanes], dy[arc_lanes], dz[arc_lanes], t[arc_lanes];

  Pairs(Random& random, const std::array<double, 9>& w, double alpha) {
    const Eigen::Vector3d axis = mapped(w, Eigen::Vector3d::UnitZ()).normalized();
    for (std::size_t i = 0; i < arc_lanes; ++i) {
      const Eigen::Vector3d d = random_direction(random);
      set(i, d, d.dot(axis) + 0.7 * alpha * random.normal());
    }
  }
  void set(std::size_t i, const Eigen::Vector3d& d, double threshold) {
    dx[i] = d.x();
    dy[i] = d.y();
    dz[i] = d.z();
    t[i] = threshold;
  }
  Eigen::Vector3d direction(std::size_t i) const { return {dx[i], dy[i], dz[i]}; }
  kernels::ArcPairs view() const { return {dx, dy, dz, t, arc_lanes}; }
};

// Roughnesses and ratios that eight nodes along an arc are enough for, to 1e-4.
const std::vector<std::array<double, 2>>& ordinary() {
  static const std::vector<std::array<double, 2>> all = {{1, 1},     {0.6, 0.5},  {0.3, 1},
                                                         {0.1, 0.7}, {0.01, 0.9}, {1, 0.5}};
  return all;
}

TEST(ArcKernels, DistributionsAreThoseOfTenMillionSamples) {
  Random random(5);
  const SampleLattice lattice(10'000'000);
  for (const auto& [alpha, lambda] : {std::array{0.7, 0.6}, std::array{0.1, 1.0}}) {
    const std::array<double, 9> w = random_map(random, alpha, lambda);
    const Pairs pairs(random, w, alpha);
    std::array<double, arc_lanes> above{};
    for (std::size_t i = 0; i < lattice.size(); ++i) {
      const double radius = std::sqrt(lattice.height[i]);
      const Eigen::Vector3d omega =
          mapped(w, {radius * lattice.cos_azimuth[i], radius * lattice.sin_azimuth[i],
                     std::sqrt(1 - lattice.height[i])});
      const double length = omega.norm();
      for (std::size_t k = 0; k < arc_lanes; ++k)
        above[k] += pairs.direction(k).dot(omega) > pairs.t[k] * length;
    }
    ArcDistributions found;
    found.evaluate(w.data(), pairs.view(), ArcNodes(64), false);
    // A lattice of n points errs by some n^(-3/4) = 6e-6.
    for (std::size_t k = 0; k < arc_lanes; ++k)
      EXPECT_NEAR(found.f[k], above[k] / static_cast<double>(lattice.size()), 3e-5) << alpha << k;
  }
}

TEST(ArcKernels, DerivativesAreThoseOfTheDistributions) {
  Random random(6);
  const ArcNodes nodes(48);
  int compared = 0;
  for (int round = 0; round < 10; ++round)
    for (const auto& [alpha, lambda] : ordinary()) {
      const std::array<double, 9> w = random_map(random, alpha, lambda);
      const Pairs pairs(random, w, alpha);
      ArcDistributions at, moved;
      at.evaluate(w.data(), pairs.view(), nodes, true);
      for (std::size_t m = 0; m < at.moving.size(); ++m) {
        if (at.moving[m] < 0)
          continue;
        const auto k = static_cast<std::size_t>(at.moving[m]);
        const double sign = pairs.t[k] < 0 ? -1 : 1;
        for (std::size_t entry = 0; entry < 9; ++entry) {
          const double scale = entry % 3 == 0 ? alpha : entry % 3 == 1 ? alpha * lambda : alpha;
          const auto value = [&](double step) {
            std::array<double, 9> other = w;
            other[entry] += step;
            moved.evaluate(other.data(), pairs.view(), nodes, false);
            return moved.f[k];
          };
          const double h = 1e-4 * scale;
          const double difference = (value(h) - value(-h)) / (2 * h) * scale;
          const double derivative = sign * at.jacobian[entry * at.jacobian_stride + m] * scale;
          // Of the difference's own error, h^2 times the third derivative.
          ASSERT_NEAR(derivative, difference, 2e-5) << alpha << ' ' << lambda << ' ' << entry;
          ++compared;
        }
      }
    }
  EXPECT_GT(compared, 2000);
}

TEST(ArcKernels, EightNodesAreEnoughForRoundLobes) {
  Random random(7);
  double largest = 0;
  for (int round = 0; round < 50; ++round)
    for (const auto& [alpha, lambda] : ordinary()) {
      const std::array<double, 9> w = random_map(random, alpha, std::max(lambda, 0.7));
      const Pairs pairs(random, w, alpha);
      ArcDistributions few, many;
      few.evaluate(w.data(), pairs.view(), ArcNodes(8), false);
      many.evaluate(w.data(), pairs.view(), ArcNodes(64), false);
      std::vector<double> errors;
      for (std::size_t k = 0; k < arc_lanes; ++k)
        errors.push_back(std::abs(few.f[k] - many.f[k]));
      largest += *std::max_element(errors.begin(), errors.end()) / 300;
    }
  // The mean over lobes of the largest error; some maps are sheared to half their roundness.
  EXPECT_LT(largest, 5e-4);
  EXPECT_GT(largest, 1e-9);  // there is something to see
}

// A cone that the horizon just touches is cut or whole by rounding: two formulas, one value. The
// positive eigenvalue of sharp lobes is one of two near zero.
TEST(ArcKernels, WholeAndCutConesMeet) {
  Random random(8);
  const ArcNodes nodes(512);
  int whole = 0;
  for (int round = 0; round < 400; ++round) {
    const double alpha = std::pow(10.0, -4 * random.uniform());
    const std::array<double, 9> w = random_map(random, alpha, 0.6 + 0.4 * random.uniform());
    const Eigen::Vector3d x = mapped(w, Eigen::Vector3d::UnitX()),
                          y = mapped(w, Eigen::Vector3d::UnitY());
    const Eigen::Vector3d up = x.cross(y).normalized();
    if (!(up.dot(mapped(w, Eigen::Vector3d::UnitZ())) > 0.3))
      continue;
    Pairs pairs(random, w, alpha);
    for (std::size_t k = 0; k < arc_lanes; k += 2) {
      const Eigen::Vector3d d = random_direction(random);
      const double touching = std::sqrt(1 - d.dot(up) * d.dot(up));
      pairs.set(k, d, touching * (1 + 1e-9));
      pairs.set(k + 1, d, touching * (1 - 1e-9));
    }
    ArcDistributions found;
    found.evaluate(w.data(), pairs.view(), nodes, false);
    for (std::size_t k = 0; k < arc_lanes; k += 2) {
      ASSERT_NEAR(found.f[k], found.f[k + 1], 1e-4) << alpha;
      whole += found.f[k] > 1e-3;
    }
  }
  EXPECT_GT(whole, 50);
}

TEST(ArcKernels, EmptyAndFullCones) {
  const std::array<double, 9> w = {0.5, 0, 0, 0, 0.5, 0, 0, 0, 1};
  Random random(9);
  Pairs pairs(random, w, 0.5);
  pairs.set(0, Eigen::Vector3d::UnitZ(), 1.5);    // no direction is so near
  pairs.set(1, Eigen::Vector3d::UnitZ(), -1.5);   // all are
  pairs.set(2, -Eigen::Vector3d::UnitZ(), 1e-3);  // below the horizon
  pairs.set(3, Eigen::Vector3d::UnitZ(), 1e-6);   // but for a rim of the horizon
  pairs.set(4, Eigen::Vector3d::UnitX(), 1e-6);   // half of it
  ArcDistributions found;
  found.evaluate(w.data(), pairs.view(), ArcNodes(16), true);
  EXPECT_EQ(found.f[0], 0);
  EXPECT_EQ(found.f[1], 1);
  EXPECT_EQ(found.f[2], 0);
  EXPECT_NEAR(found.f[3], 1, 1e-9);
  EXPECT_NEAR(found.f[4], 0.5, 1e-5);
}

TEST(ArcKernels, EveryVectorUnitAgrees) {
  Random random(10);
  const std::array<double, 9> w = random_map(random, 0.3, 0.7);
  const Pairs pairs(random, w, 0.3);
  ArcDistributions usual;
  usual.evaluate(w.data(), pairs.view(), ArcNodes(8), false);
  const std::vector<double> expected(usual.f.begin(), usual.f.begin() + arc_lanes);
  int units = 0;
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    ArcDistributions found;
    found.evaluate(w.data(), pairs.view(), ArcNodes(8), false);
    for (std::size_t k = 0; k < arc_lanes; ++k)
      EXPECT_NEAR(found.f[k], expected[k], 1e-12) << hwy::TargetName(target);
    ++units;
  }
  hwy::SetSupportedTargetsForTest(0);
  EXPECT_GE(units, 1);
}

struct Model {
  explicit Model(const Lobe& lobe, ArcRule::Reach reach = ArcRule::Reach::near)
      : frame(lobe), rule(32, 16, reach) {
    TargetSamples samples;
    AlignedFloats xi;
    sample_weighted_target(frame, make_target_lattice(32768, 0.3), samples);
    set_target(samples, directions, rule, xi, target);
    start = moment_start(frame, samples);
    start /= start.col(2).norm();
  }
  double loss(const Eigen::Matrix3d& p) {
    return arc_loss(point_of_frame(frame, p), {directions, rule, target}, workspace);
  }

  LobeFrame frame;
  ArcDirections directions = in_float(fibonacci_directions(64));
  ArcRule rule;
  ArcTarget target;
  ArcWorkspace workspace;
  Eigen::Matrix3d start;
};

double judged(const Lobe& lobe, const LobeFrame& frame, const Eigen::Matrix3d& p) {
  HeldOutJudge judge;
  judge.set_lobe(lobe);
  return judge.loss({frame.to_matrix(p)});
}

TEST(ArcModel, LossIsTheSortedOne) {
  for (Lobe lobe : test::ordinary_lobes()) {
    Model model(lobe);
    // 64 directions turned otherwise, and 32 thresholds.
    EXPECT_NEAR(model.loss(model.start) / judged(lobe, model.frame, model.start), 1, 0.04)
        << test::describe(lobe);
  }
}

TEST(ArcModel, FarThresholdsSeeALobeThatIsMuchTooWide) {
  const Lobe lobe{1e-3, 1e-3, 0.5, 0.3};
  Model near(lobe), far(lobe, ArcRule::Reach::far);
  Eigen::Matrix3d wide = near.start;
  wide.leftCols<2>() *= 300;
  const double expected = judged(lobe, near.frame, wide);
  // One threshold an octave.
  EXPECT_NEAR(far.loss(wide) / expected, 1, 0.1);
  EXPECT_LT(near.loss(wide) / expected, 0.5);
}

TEST(ArcModel, GradientIsThatOfItsLoss) {
  for (const Lobe& lobe : test::ordinary_lobes()) {
    Model model(lobe);
    const ArcView view{model.directions, model.rule, model.target};
    ModelValue value;
    evaluate_arcs(point_of_frame(model.frame, model.start), view, 1e-4 * model.target.spread,
                  model.workspace, value);
    EXPECT_NEAR(value.loss, model.loss(model.start), 1e-12);
    EXPECT_LT((value.curvature - value.curvature.transpose()).norm(), 1e-12);
    const Eigen::Matrix3d step = 1e-3 * unflattened(value.gradient) / value.gradient.norm();
    const double difference = (model.loss(model.start + step) - model.loss(model.start - step)) / 2;
    // Residuals near zero count less in the gradient.
    EXPECT_NEAR(difference / flattened(step).dot(value.gradient), 1, 0.03) << test::describe(lobe);
    // The scale of P moves nothing.
    EXPECT_LT(std::abs(flattened(model.start).dot(value.gradient)),
              1e-4 * value.gradient.norm() * model.start.norm());
  }
}

// With respect to S where W = turn P A = S diag(scale).
TEST(ArcModel, PointsOfOtherFramesAgree) {
  const Lobe lobe{0.4, 0.2, 0.9, 0.6};
  Model model(lobe);
  const ArcView view{model.directions, model.rule, model.target};
  ModelValue in_frame, in_world;
  evaluate_arcs(point_of_frame(model.frame, model.start), view, 1e-3, model.workspace, in_frame);
  ArcPoint world{model.frame, model.frame.to_matrix(model.start), Eigen::Vector3d::Ones()};
  world.turn = model.frame.rotation;
  evaluate_arcs(world, view, 1e-3, model.workspace, in_world);
  EXPECT_NEAR(in_world.loss, in_frame.loss, 1e-10);
  const Eigen::Matrix3d expected =
      model.frame.rotation * unflattened(in_frame.gradient) *
      Eigen::Vector3d(1 / lobe.alpha_x, 1 / lobe.alpha_y, 1).asDiagonal();
  EXPECT_LT((unflattened(in_world.gradient) - expected).norm(), 1e-7 * expected.norm());
}

}  // namespace
}  // namespace ltc
