// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/gauss_newton.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.h"
#include "fit/lobes.h"
#include "fit/starting_points.h"
#include "judge/held_out.h"
#include "statistics.h"

namespace ltc {
namespace {

// Matrices of the same lobe agree once scale and the rotation about z are taken out: M M^T up to a
// factor does, and determines the density. With P and the roughness: (PA)(PA)^T, here of unit
// determinant. The digits in which its entries agree, in the variables where all entries of P are
// of the order of one.
double matching_digits(const LobeFrame& frame, const Eigen::Matrix3d& found,
                       const Eigen::Matrix3d& planted) {
  const auto shape = [&](const Eigen::Matrix3d& p) {
    const Eigen::Vector3d roughness(frame.lobe.alpha_x, frame.lobe.alpha_y, 1);
    const Eigen::Matrix3d m = p * roughness.asDiagonal();
    Eigen::Matrix3d square = m * m.transpose();
    square /= std::cbrt(square.determinant());
    return square;
  };
  const Eigen::Matrix3d a = shape(found), b = shape(planted);
  return -std::log10((a - b).norm() / b.norm());
}

struct Planted {
  Planted(const Lobe& lobe, std::uint64_t seed) : frame(lobe) {
    test::Uniform uniform(seed);
    planted = frame.first_order;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 2; ++column)
        planted(row, column) *= 0.8 + 0.4 * uniform();
    planted(0, 2) = 0.2 * uniform() * lobe.alpha_x;
    planted(1, 2) = -0.2 * uniform() * lobe.alpha_y;
    // Another lattice than the fit's, sixteen times as fine.
    samples = test::planted_target(frame, planted, make_cosine_set(16384, 0.41));
    quantiles.build(samples, in_float(fibonacci_directions(32)), 64, workspace.xi, workspace.bins);
  }

  Descent descend(const Eigen::Matrix3d& start, int steps, std::vector<FitStep>* trace = nullptr) {
    DescentOptions options;
    options.steps = steps;
    options.tolerance = 0;
    return minimise({frame, start, free_entries(frame.lobe), cosines, quantiles}, options,
                    workspace, trace);
  }

  LobeFrame frame;
  Eigen::Matrix3d planted;
  TargetSamples samples;
  CosineSet cosines = make_cosine_set(1024);
  TargetQuantiles quantiles;
  ModelWorkspace workspace;
};

const std::vector<Lobe> kPlantedLobes = {
    {0.5, 0.4, 0.6, 0.4}, {0.8, 0.3, 0.9, 1.0}, {0.3, 0.1, 1.0, 1.2}, {0.05, 0.02, 0.5, 0.7}};

TEST(GaussNewton, FindsAPlantedOptimumFromSeveralStarts) {
  std::uint64_t seed = 1;
  for (const Lobe& lobe : kPlantedLobes) {
    Planted problem(lobe, seed++);
    const double planted_loss = problem.descend(problem.planted, 0).loss;
    const Eigen::Matrix3d starts[] = {
        first_order_start(problem.frame), moment_start(problem.frame, problem.samples),
        identity_start(problem.frame), random_start(problem.frame, problem.samples, 5)};
    for (std::size_t s = 0; s < std::size(starts); ++s) {
      const Descent descent = problem.descend(starts[s], 60);
      const double digits = matching_digits(problem.frame, descent.frame_matrix, problem.planted);
      // Measured: 2.43 to 3.11 digits, from starts of -0.19 to 1.6 digits. What is missing is the
      // difference of the two lattices, by which the planted matrix itself loses 0.003 to 0.012 of
      // the spread: the minimum, 0.86 to 0.97 of that, lies below it.
      EXPECT_GT(digits, 2.3) << test::describe(lobe) << " start " << s;
      EXPECT_LT(descent.loss, planted_loss) << test::describe(lobe) << " start " << s;
    }
    EXPECT_LT(planted_loss, 0.015 * problem.quantiles.spread()) << test::describe(lobe);
  }
}

TEST(GaussNewton, ScoresAWrongMatrixLow) {
  const LobeFrame frame({0.5, 0.4, 0.6, 0.4});
  Eigen::Matrix3d wrong = frame.first_order;
  wrong.col(0) *= 1.1;
  EXPECT_LT(matching_digits(frame, wrong, frame.first_order), 1.5);
  // Scale and rotation about z do not count.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << 0.8, -0.6, 0.6, 0.8;
  const Eigen::DiagonalMatrix<double, 3> roughness(0.5, 0.4, 1);
  EXPECT_GT(matching_digits(frame, 3 * frame.first_order * roughness * turn * roughness.inverse(),
                            frame.first_order),
            12);
}

TEST(GaussNewton, TakesNoStepThatLoses) {
  // Step by step, by ending the same descent one step later each time: loss and prior together
  // never rise.
  int falls = 0;
  for (const Lobe& lobe : test::all_lobes()) {
    const LobeFrame frame(lobe);
    TargetSamples samples;
    sample_weighted_target(frame, make_target_lattice(4096, 0.3), samples);
    TargetQuantiles quantiles;
    ModelWorkspace workspace;
    quantiles.build(samples, in_float(fibonacci_directions(16)), 32, workspace.xi, workspace.bins);
    const CosineSet cosines = make_cosine_set(256);
    for (const Eigen::Matrix3d& start :
         {first_order_start(frame), moment_start(frame, samples), identity_start(frame),
          random_start(frame, samples, 3), random_start(frame, samples, 4)}) {
      double previous_objective = 0;
      for (int steps = 0; steps <= 30; ++steps) {
        DescentOptions options;
        options.steps = steps;
        std::vector<FitStep> trace;
        const Descent descent = minimise({frame, start, free_entries(lobe), cosines, quantiles},
                                         options, workspace, &trace);
        const Eigen::Matrix3d& p = descent.frame_matrix;
        EXPECT_EQ(static_cast<std::size_t>(descent.steps), trace.size());
        EXPECT_TRUE(p.allFinite()) << test::describe(lobe);
        EXPECT_GT(p.determinant(), 0) << test::describe(lobe);
        EXPECT_GT(frame.to_matrix(p).determinant(), 0) << test::describe(lobe);
        EXPECT_NEAR(p.col(2).norm(), 1, 1e-14);
        for (int entry = 0; entry < 9; ++entry)
          if (!free_entries(lobe)[entry]) {
            EXPECT_EQ(p(entry / 3, entry % 3), 0) << test::describe(lobe);
          }
        const double objective =
            descent.loss + prior(frame, quantiles.spread(), p, DescentOptions().prior_weight);
        if (steps > 0) {
          // But for the rounding of the sum here and there.
          EXPECT_LE(objective, previous_objective * (1 + 1e-12))
              << test::describe(lobe) << " step " << steps;
          EXPECT_EQ(descent.loss, trace.back().loss) << test::describe(lobe);
          falls += objective < previous_objective;
        }
        previous_objective = objective;
        if (descent.steps < steps)
          break;  // it has ended by itself
      }
    }
  }
  // The comparison above has seen steps that gain: turned about, it would have failed.
  EXPECT_GT(falls, 100);
}

TEST(GaussNewton, AMatrixThatIsNotFiniteIsNotImprovedInto) {
  Planted problem({0.5, 0.4, 0.6, 0.4}, 1);
  Eigen::Matrix3d start = problem.planted;
  start(0, 0) = std::numeric_limits<double>::quiet_NaN();
  const Descent descent = problem.descend(start, 30);
  EXPECT_TRUE(std::isnan(descent.loss));
}

TEST(GaussNewton, ZeroStepsReturnTheStart) {
  Planted problem({0.5, 0.4, 0.6, 0.4}, 1);
  const Eigen::Matrix3d start = first_order_start(problem.frame);
  const Descent descent = problem.descend(start, 0);
  EXPECT_EQ(descent.steps, 0);
  EXPECT_LT((descent.frame_matrix - start).norm(), 1e-14);
  EXPECT_FALSE(descent.converged);
}

// The held-out loss of what the default settings fit.
double fitted_loss(const Lobe& lobe) {
  FitRequest request;
  request.lobe = lobe;
  const Eigen::Matrix3d m = make_solver({})->fit(request, *make_fit_workspace(), nullptr).matrix;
  HeldOutJudge judge;
  judge.set_lobe(lobe);
  return judge.loss(m);
}

// Lobes of brushed metal seen obliquely to the brush, alpha_y = 1e-4: they lie on a cone. A matrix
// whose thin column stays thin is a minimum too, a twentieth above the one that opens; for each of
// these lobes some setting of damping, smoothing and start led there.
TEST(GaussNewtonSolver, OpensThinBentLobes) {
  const double node = radians_of_degrees(89.991 / 7), azimuth = radians_of_degrees(90.0 / 7);
  const struct {
    Lobe lobe;
    double reference_loss;  // held out, of config/reference.toml
  } cases[] = {{{3.0 / 7, 1e-4, 2 * node, azimuth}, 6.5623e-3},
               {{4.0 / 7, 1e-4, node, azimuth}, 3.9208e-3},
               {{5.0 / 7, 1e-4, node, azimuth}, 4.1599e-3}};
  for (const auto& [lobe, reference_loss] : cases)
    // Measured: 1.0022, 1.0027 and 1.0025 times; thin ones had 1.03 to 1.10 times.
    EXPECT_LT(fitted_loss(lobe), 1.01 * reference_loss) << test::describe(lobe);
}

// Near the horizon few samples of a thin lobe have a minimum of their own: on a quarter of them
// this one ended at 1.062 times the reference's loss.
TEST(GaussNewtonSolver, SeesThatItFollowedItsSamples) {
  const Lobe lobe{1, 0.01, radians_of_degrees(89), radians_of_degrees(90)};
  constexpr double reference_loss = 2.5065e-3;          // held out, of config/reference.toml
  EXPECT_LT(fitted_loss(lobe), 1.02 * reference_loss);  // measured: 1.006 times
}

TEST(GaussNewtonSolver, ReturnsAPositiveDeterminantAndTheSameBitsInAnyWorkspace) {
  const std::unique_ptr<Solver> solver = make_solver({});
  FitWorkspacePointer shared = make_fit_workspace();
  for (const Lobe& lobe : test::all_lobes()) {
    FitRequest request;
    request.lobe = lobe;
    const FitResult used = solver->fit(request, *shared, nullptr);
    const FitResult fresh = solver->fit(request, *make_fit_workspace(), nullptr);
    EXPECT_EQ(used.matrix, fresh.matrix) << test::describe(lobe);
    EXPECT_EQ(used.loss, fresh.loss) << test::describe(lobe);
    EXPECT_GT(used.matrix.determinant(), 0) << test::describe(lobe);
    EXPECT_NE(used.outcome, FitOutcome::non_finite) << test::describe(lobe);
  }
}

// Whatever is given, the result is as good as from the solver's own starts.
TEST(GaussNewtonSolver, AbandonsStartsThatLeadNowhere) {
  FitSettings on_samples;  // as given starts are descended from
  on_samples.gauss_newton.loss = LossKind::samples;
  const std::unique_ptr<Solver> solver = make_solver(on_samples);
  FitRequest request;
  request.lobe = {0.5, 0.4, 0.6, 0.4};
  const FitResult own = solver->fit(request, *make_fit_workspace(), nullptr);
  EXPECT_FALSE(own.start_abandoned);
  request.starts = {Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN()),
                    Eigen::Matrix3d::Zero()};
  std::vector<FitStep> trace;
  const FitResult result = solver->fit(request, *make_fit_workspace(), &trace);
  EXPECT_TRUE(result.start_abandoned);
  EXPECT_EQ(result.matrix, own.matrix);
  ASSERT_FALSE(trace.empty());
  EXPECT_EQ(trace.front().phase.kind, FitPhase::Kind::own_start);
}

// Scale and sign move no lobe.
TEST(GaussNewtonSolver, TakesAGoodStartInAnyScaleAndSign) {
  const std::unique_ptr<Solver> solver = make_solver({});
  FitRequest request;
  request.lobe = {0.5, 0.4, 0.6, 0.4};
  const Eigen::Matrix3d good = solver->fit(request, *make_fit_workspace(), nullptr).matrix;
  request.starts = {good};
  const FitResult expected = solver->fit(request, *make_fit_workspace(), nullptr);
  EXPECT_FALSE(expected.start_abandoned);
  for (const double factor : {0x1p-20, 0x1p20, -1.0}) {
    request.starts = {factor * good};
    const FitResult result = solver->fit(request, *make_fit_workspace(), nullptr);
    EXPECT_FALSE(result.start_abandoned);
    EXPECT_EQ(result.matrix, expected.matrix) << factor;
  }
}

}  // namespace
}  // namespace ltc
