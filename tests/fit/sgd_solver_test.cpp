// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/sgd_solver.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "fit/lobes.h"
#include "judge/held_out.h"

namespace ltc {
namespace {

const Lobe kLobe{0.5, 0.25, 0.7, 0.6};

// 300 steps whose sizes fall by a factor of e^-3.
SgdSettings short_run() {
  SgdSettings settings;
  settings.steps = 300;
  settings.samples = 256;
  settings.directions = 16;
  settings.step_decay = 0.99;
  return settings;
}

FitResult fit(const SgdSettings& settings, TargetKind target, std::uint64_t seed,
              std::vector<FitStep>* trace = nullptr) {
  FitRequest request;
  request.lobe = kLobe;
  request.seed = seed;
  return SgdSolver(settings, target).fit(request, *make_fit_workspace(), trace);
}

TEST(Sgd, DescendsInBothVariablesAndWithBothTargets) {
  HeldOutJudge judge(2048, 16);
  judge.set_lobe(kLobe);
  const double start = judge.loss(Eigen::Matrix3d::Identity());
  for (const bool scaled : {false, true})
    for (const TargetKind target : {TargetKind::rejection, TargetKind::weighted}) {
      SgdSettings settings = short_run();
      settings.scaled_variables = scaled;
      const FitResult result = fit(settings, target, 1);
      const double end = judge.loss(result.matrix);
      // Measured: from 0.204 to 0.012, scaled to 0.024.
      EXPECT_LT(end, start / 5);
      EXPECT_GT(result.matrix.determinant(), 0);
      EXPECT_EQ(result.steps, 300);
    }
}

TEST(Sgd, WithoutStepsOfAnySizeNothingIsGained) {
  SgdSettings settings = short_run();
  settings.step_scale = 1e-12;
  const FitResult result = fit(settings, TargetKind::rejection, 1);
  EXPECT_LT((result.matrix - Eigen::Matrix3d::Identity()).norm(), 1e-8);
}

TEST(Sgd, TheSeedAloneDecidesTheBits) {
  const FitResult first = fit(short_run(), TargetKind::rejection, 7);
  const FitResult again = fit(short_run(), TargetKind::rejection, 7);
  const FitResult other = fit(short_run(), TargetKind::rejection, 8);
  EXPECT_EQ(first.matrix, again.matrix);
  EXPECT_EQ(first.loss, again.loss);
  EXPECT_NE(first.matrix, other.matrix);
}

TEST(Sgd, AWorkspaceRemembersNothing) {
  FitRequest request;
  request.lobe = kLobe;
  request.seed = 7;
  const SgdSolver solver(short_run(), TargetKind::weighted);
  FitWorkspacePointer used = make_fit_workspace();
  SgdSettings larger = short_run();
  larger.samples = 512;
  larger.steps = 5;
  SgdSolver(larger, TargetKind::rejection).fit(request, *used, nullptr);
  make_solver({})->fit(request, *used, nullptr);
  EXPECT_EQ(solver.fit(request, *used, nullptr).matrix,
            solver.fit(request, *make_fit_workspace(), nullptr).matrix);
}

TEST(Sgd, TheFirstGradientIsTheReferences) {
  // One step from a start changes W by -step gradient; W is M where the variables are not scaled.
  // Against the gradient in double on other samples and directions: the same in the mean.
  SgdSettings settings = short_run();
  settings.steps = 1;
  settings.samples = 4096;
  settings.directions = 256;
  settings.step_scale = 0.1;
  const FitResult result = fit(settings, TargetKind::weighted, 3);
  const Eigen::Matrix3d step = (Eigen::Matrix3d::Identity() - result.matrix) / 0.1;
  const LobeFrame frame(kLobe);
  TargetSamples target;
  sample_weighted_target(frame, make_target_lattice(1024), target);
  const SlicedWassersteinLoss loss(test::in_double(make_cosine_set(1024)), test::in_double(target),
                                   fibonacci_directions(128));
  const Eigen::Matrix3d reference = frame.rotation * loss(frame.rotation.transpose()).gradient;
  // Measured: 0.08; 256 random directions have a noise of 1/16.
  EXPECT_LT((step - reference).norm(), 0.15 * reference.norm());
}

TEST(Sgd, KeepsTheZerosOfSymmetry) {
  FitRequest request;
  request.lobe = {0.5, 0.25, 0.7, 0.0};
  for (const bool scaled : {false, true}) {
    SgdSettings settings = short_run();
    settings.scaled_variables = scaled;
    const FitResult result =
        SgdSolver(settings, TargetKind::weighted).fit(request, *make_fit_workspace(), nullptr);
    for (const auto& [row, column] : {std::pair{0, 1}, {1, 0}, {1, 2}, {2, 1}})
      EXPECT_EQ(result.matrix(row, column), 0);
  }
}

TEST(Sgd, AveragesTheLastSteps) {
  SgdSettings settings = short_run();
  settings.steps = 2;
  const Eigen::Matrix3d second = fit(settings, TargetKind::rejection, 4).matrix;
  settings.averaged_steps = 2;
  const Eigen::Matrix3d average = fit(settings, TargetKind::rejection, 4).matrix;
  settings.averaged_steps = 1;
  settings.steps = 1;
  const Eigen::Matrix3d first = fit(settings, TargetKind::rejection, 4).matrix;
  EXPECT_LT((average - (first + second) / 2).norm(), 1e-14);
  EXPECT_GT((average - second).norm(), 1e-6);
}

}  // namespace
}  // namespace ltc
