// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/l3_nelder_mead.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

#include "fit/lobes.h"
#include "fit/starting_points.h"
#include "judge/held_out.h"
#include "ltc/ltsd.h"

namespace ltc {
namespace {

const Lobe kModerate{0.5, 0.25, 0.7, 0.6};

const CosineSet& cosines() {
  static const CosineSet set = make_cosine_set(1024);
  return set;
}
const TargetLattice& lattice() {
  static const TargetLattice set = make_target_lattice(1024, 0.3);
  return set;
}

L3Error error_of(const Lobe& lobe, const CosineSet& set = cosines(),
                 const TargetLattice& points = lattice()) {
  return lobe_l3_error(lobe, integrate_albedo(lobe, AlbedoRule()).amplitude, points, set);
}

// A lobe that is an LTC itself: the optimum is known, and its error is zero.
L3Error planted(const Eigen::Matrix3d& matrix) {
  const LinearlyTransformed ltc(matrix);
  const CosineSet drawn = make_cosine_set(1024, 0.37);
  std::vector<Eigen::Vector3d> samples;
  for (const Eigen::Vector3d& omega_o : test::in_double(drawn))
    samples.push_back((matrix * omega_o).normalized());
  return L3Error(
      [ltc](const Eigen::Vector3d& omega) {
        const double density = ltc.density(omega);
        return L3Error::Densities{density, density};
      },
      samples, cosines());
}

FitResult fit(const Lobe& lobe, const L3Settings& settings = {},
              std::vector<FitStep>* trace = nullptr) {
  FitRequest request;
  request.lobe = lobe;
  return L3NelderMeadSolver(settings).fit(request, *make_fit_workspace(), trace);
}

double held_out(const Lobe& lobe, const Eigen::Matrix3d& matrix) {
  HeldOutJudge judge(4096, 32);
  judge.set_lobe(lobe);
  return judge.loss(matrix);
}

// ---- The error ----

TEST(L3Error, OfTwoCosinesIsZeroAndOfAnotherIsNot) {
  const L3Error error = planted(Eigen::Matrix3d::Identity());
  EXPECT_EQ(error(Eigen::Matrix3d::Identity()), 0);
  EXPECT_GT(error(Eigen::Vector3d(0.9, 1, 1).asDiagonal()), 0.01);
}

// Against the uniform hemisphere the integral is in closed form: with z = cos theta,
// int |z/pi - 1/(2 pi)|^3 d omega = 2 pi/(8 pi^3) int_0^1 |2 z - 1|^3 dz = 1/(16 pi^2).
TEST(L3Error, AgreesWithTheClosedForm) {
  constexpr double uniform = 1 / (2 * std::numbers::pi);
  std::vector<Eigen::Vector3d> samples;
  constexpr int count = 4096;
  for (int i = 0; i < count; ++i)
    samples.push_back(sample_original(Original::uniform_hemisphere, (i + 0.5) / count,
                                      std::fmod(i * std::numbers::phi, 1)));
  const L3Error error(
      [](const Eigen::Vector3d& omega) {
        return omega.z() >= 0 ? L3Error::Densities{uniform, uniform} : L3Error::Densities{};
      },
      samples, cosines());
  const double exact = std::cbrt(1 / (16 * std::numbers::pi * std::numbers::pi));
  // Stratified in z, on which alone the integrand depends: 1024 strata leave well below 1e-3.
  EXPECT_NEAR(error(Eigen::Matrix3d::Identity()), exact, 1e-3 * exact);
}

TEST(L3Error, DoesNotDependOnScaleSignOrTurn) {
  const L3Error error = error_of(kModerate);
  const LobeFrame frame(kModerate);
  const Eigen::Matrix3d matrix = frame.to_matrix(first_order_start(frame));
  const double value = error(matrix);
  EXPECT_NEAR(error(-3 * matrix), error(-matrix), 1e-12 * value);
  EXPECT_NEAR(error(7 * matrix), value, 1e-12 * value);
  Eigen::Matrix3d mirrored = matrix;
  mirrored.col(1) = -mirrored.col(1);
  // The same LTC through other samples of it: what 1024 leave.
  EXPECT_NEAR(error(mirrored), value, 0.02 * value);
}

TEST(L3Error, MoreSamplesAgree) {
  const LobeFrame frame(kModerate);
  const Eigen::Matrix3d matrix = frame.to_matrix(first_order_start(frame));
  const CosineSet many = make_cosine_set(65536);
  const double few = error_of(kModerate)(matrix);
  const double exact = error_of(kModerate, many, make_target_lattice(65536, 0.3))(matrix);
  EXPECT_NEAR(few, exact, 0.02 * exact);
}

TEST(L3Error, IsInfiniteWithoutADistribution) {
  const L3Error error = error_of(kModerate);
  EXPECT_EQ(error(Eigen::Matrix3d::Zero()), std::numeric_limits<double>::infinity());
  EXPECT_EQ(error(Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN())),
            std::numeric_limits<double>::infinity());
}

// ---- The search ----

TEST(L3NelderMead, FindsAPlantedLobe) {
  const LobeFrame frame(kModerate);
  const Eigen::Matrix3d optimum = first_order_start(frame);
  const L3Error error = planted(frame.to_matrix(optimum));
  Eigen::Matrix3d start = optimum;
  start.col(0) *= 1.4;
  start.col(1) *= 0.7;
  start(0, 2) += 0.1;
  L3Settings settings;
  settings.evaluations = 4000;
  const double before = error(frame.to_matrix(start));
  const SimplexSearch search =
      search_by_simplex(frame, start, free_entries(kModerate), error, settings, nullptr, nullptr);
  EXPECT_LT(search.error, 1e-3 * before);
  EXPECT_LT(held_out(kModerate, frame.to_matrix(search.frame_matrix)), 1);
}

TEST(L3NelderMead, ReducesItsOwnError) {
  for (const Lobe& lobe : test::ordinary_lobes()) {
    const LobeFrame frame(lobe);
    const Eigen::Matrix3d start = first_order_start(frame);
    const L3Error error = error_of(lobe);
    const SimplexSearch search =
        search_by_simplex(frame, start, free_entries(lobe), error, {}, nullptr, nullptr);
    EXPECT_LT(search.error, error(frame.to_matrix(start))) << test::describe(lobe);
    EXPECT_LE(search.evaluations, L3Settings{}.evaluations);
  }
}

TEST(L3NelderMead, WithOneEvaluationGivesTheStartBack) {
  L3Settings settings;
  settings.evaluations = 1;
  const LobeFrame frame(kModerate);
  const FitResult result = fit(kModerate, settings);
  EXPECT_LT((result.matrix - frame.to_matrix(first_order_start(frame))).norm(), 1e-14);
  EXPECT_EQ(result.outcome, FitOutcome::step_limit);
  EXPECT_EQ(result.steps, 1);
}

TEST(L3NelderMead, TheTraceHoldsEveryEvaluation) {
  std::vector<FitStep> trace;
  const FitResult result = fit(kModerate, {}, &trace);
  ASSERT_EQ(trace.size(), static_cast<std::size_t>(result.steps));
  double best = std::numeric_limits<double>::infinity();
  for (const FitStep& step : trace) {
    EXPECT_EQ(step.accepted, step.loss < best);
    best = std::min(best, step.loss);
  }
}

TEST(L3NelderMead, KeepsSymmetryZerosAndTheDeterminant) {
  const FitResult result = fit({0.5, 0.25, 0.7, 0.0});
  for (const auto& [row, column] : {std::pair{0, 1}, {1, 0}, {1, 2}, {2, 1}})
    EXPECT_EQ(result.matrix(row, column), 0);
  EXPECT_GT(result.matrix.determinant(), 0);
}

TEST(L3NelderMead, ReportsTheSlicedWassersteinLoss) {
  const FitResult result = fit(kModerate);
  const double expected = held_out(kModerate, result.matrix);
  // 2048 samples against 4096 others.
  EXPECT_NEAR(result.loss, expected, 0.1 * expected);
}

TEST(L3NelderMead, StartsWhereItIsTold) {
  FitRequest request;
  request.lobe = kModerate;
  request.starts = {2 * Eigen::Matrix3d::Identity()};
  L3Settings settings;
  settings.evaluations = 1;
  const FitResult result =
      L3NelderMeadSolver(settings).fit(request, *make_fit_workspace(), nullptr);
  EXPECT_LT((result.matrix - 2 * Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

// What Aakash et al. 2022 (section 4.1) say of the method, and why it is a baseline only.
TEST(L3NelderMead, FromTheCosineItLosesSharpLobes) {
  const Lobe sharp{0.01, 0.01, 0.7, 0.6};
  L3Settings settings;
  settings.start = StartKind::identity;
  const LobeFrame frame(sharp);
  const double lost = held_out(sharp, fit(sharp, settings).matrix);
  const double start = held_out(sharp, frame.to_matrix(first_order_start(frame)));
  EXPECT_GT(lost, 2 * start);
}

TEST(L3NelderMead, NeverReturnsWhatIsNotFinite) {
  L3Settings settings;
  settings.evaluations = 100;
  for (const StartKind start : {StartKind::first_order, StartKind::identity}) {
    settings.start = start;
    for (const Lobe& lobe : test::all_lobes()) {
      const FitResult result = fit(lobe, settings);
      if (result.outcome == FitOutcome::non_finite) {
        EXPECT_TRUE(std::isnan(result.loss)) << test::describe(lobe);
        continue;
      }
      EXPECT_TRUE(result.matrix.allFinite()) << test::describe(lobe);
      EXPECT_GT(result.matrix.determinant(), 0) << test::describe(lobe);
      EXPECT_TRUE(std::isfinite(result.loss)) << test::describe(lobe);
    }
  }
}

// A simplex with no extent is no simplex: NLopt threw "zero step size".
TEST(L3NelderMead, AStartWithoutExtentIsAFailureNotACrash) {
  FitRequest request;
  request.lobe = kModerate;
  const auto solver = [] {
    FitSettings settings;
    settings.solver = SolverKind::l3_nelder_mead;
    settings.l3.evaluations = 10;
    return make_solver(settings);
  }();
  Eigen::Matrix3d singular = Eigen::Matrix3d::Identity();
  singular.col(1).setZero();
  for (const Eigen::Matrix3d& start :
       {singular, Eigen::Matrix3d(Eigen::Matrix3d::Constant(std::nan("")))}) {
    request.starts = {start};
    EXPECT_EQ(solver->fit(request, *make_fit_workspace(), nullptr).outcome, FitOutcome::non_finite);
  }
}

}  // namespace
}  // namespace ltc
