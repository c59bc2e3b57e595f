// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A short stress run.
#include "stress/run.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <set>

#include "stress/report.h"
#include "stress/verdict.h"

namespace ltc {
namespace {

// From all corners of the ranges, one in some of the quick grid's lobes, and random ones.
std::vector<StressLobe> short_list() {
  std::vector<StressLobe> lobes;
  const std::vector<StressLobe> grid = grid_lobes(stress_axes(StressDensity::quick));
  for (std::size_t i = 0; i < grid.size(); i += 5)
    lobes.push_back(grid[i]);
  for (const StressLobe& lobe : random_lobes(3, 3))
    lobes.push_back(lobe);
  return lobes;
}

StressTask short_task() {
  StressTask task;
  task.lobes = short_list();
  task.judge.samples = 4096;
  task.judge.directions = 32;
  return task;
}

// The bars of the long run.
TEST(Stress, ShortRun) {
  const StressTask task = short_task();
  const StressRun run = run_stress(task, {2});
  const StressVerdict verdict = judge_stress(run.fits, 3);
  EXPECT_EQ(verdict.missed_bars, std::vector<std::string>());
  EXPECT_EQ(verdict.own.missed, 0u);
  EXPECT_GE(verdict.bad.success_rate(), least_success_from_bad_starts);
  // No start was passed over.
  EXPECT_GE(run.fits.size(), 200u);
  for (const StressCounts& counts : verdict.by_start)
    EXPECT_EQ(counts.fits, task.lobes.size());
  // And they were what they are called: the solver had to abandon those that have no lobe.
  for (std::size_t start = 0; start < stress_starts().size(); ++start) {
    const StressStart kind = stress_starts()[start].start;
    if (kind == StressStart::singular || kind == StressStart::not_a_number) {
      EXPECT_EQ(verdict.by_start[start].abandoned, task.lobes.size());
    }
  }
  EXPECT_EQ(verdict.by_start[0].abandoned, 0u);
}

// Never worse than the LTC of the same lobe, and mostly better.
TEST(Stress, ShortRunOfFolds) {
  StressTask task = short_task();
  task.fit.lobe = LobeKind::folded;
  const StressRun run = run_stress(task, {2});
  const StressVerdict verdict = judge_stress(run.fits, 3);
  EXPECT_EQ(verdict.missed_bars, std::vector<std::string>());
  EXPECT_EQ(verdict.bad.failures(), 0u);
  std::size_t folded = 0, better = 0;
  for (const StressFit& fit : run.fits) {
    folded += fit.fold != Fold{};
    better += fit.ratio < 0.95;
  }
  // Of the lobes of the list, two thirds are neither isotropic nor those of the closed form.
  EXPECT_GT(folded, run.fits.size() / 4);
  EXPECT_GT(better, run.fits.size() / 8);
}

TEST(Stress, SameBitsWithAnyNumberOfThreads) {
  StressTask task = short_task();
  task.lobes.resize(3);
  const StressRun one = run_stress(task, {1}), three = run_stress(task, {3});
  ASSERT_EQ(one.fits.size(), three.fits.size());
  for (std::size_t i = 0; i < one.fits.size(); ++i) {
    EXPECT_EQ(one.fits[i].matrix, three.fits[i].matrix);
    EXPECT_EQ(one.fits[i].ratio, three.fits[i].ratio);
  }
}

// ---- Starts ----

TEST(StressStarts, AreAllDifferentAndAsNamed) {
  const Lobe lobe{0.01, 0.001, 0.9, 0.4};
  std::set<std::string> names;
  std::vector<Eigen::Matrix3d> matrices;
  for (const StressStartKind& kind : stress_starts()) {
    names.insert(kind.name);
    const std::optional<Eigen::Matrix3d> m = start_matrix(kind.start, lobe, 5);
    ASSERT_EQ(m.has_value(), kind.start != StressStart::solver_choice);
    if (!m)
      continue;
    for (const Eigen::Matrix3d& other : matrices)
      EXPECT_NE(*m, other) << kind.name;
    matrices.push_back(*m);
    const double determinant = m->determinant();
    switch (kind.start) {
      case StressStart::reflected:
      case StressStart::negated:
      case StressStart::exchanged:
        EXPECT_LT(determinant, 0) << kind.name;
        break;
      case StressStart::singular:
        EXPECT_EQ(determinant, 0);
        break;
      case StressStart::not_a_number:
        EXPECT_FALSE(m->allFinite());
        break;
      default:
        EXPECT_NE(determinant, 0) << kind.name;
    }
  }
  EXPECT_EQ(names.size(), stress_starts().size());
}

// ---- Lobes ----

TEST(StressLobes, CoverTheRanges) {
  const StressAxes axes = stress_axes(StressDensity::full);
  const std::vector<StressLobe> lobes = grid_lobes(axes);
  EXPECT_EQ(lobes.size(), axes.size());
  EXPECT_GE(lobes.size() * stress_starts().size(), 20000u);
  EXPECT_EQ(axes.alpha.size(), 7u);
  EXPECT_NEAR(axes.alpha.front(), 1e-6, 1e-20);
  EXPECT_EQ(axes.alpha.back(), 1);
  EXPECT_EQ(axes.theta_degrees.back(), 89.999);
  for (const StressLobe& lobe : random_lobes(500, 1)) {
    EXPECT_GE(lobe.lobe().alpha_y, 0.999e-12);
    EXPECT_LE(lobe.alpha, 1);
    EXPECT_GE(lobe.theta_degrees, 0);
    EXPECT_LE(lobe.theta_degrees, 89.9990001);
    EXPECT_GE(lobe.phi_degrees, 0);
    EXPECT_LE(lobe.phi_degrees, 90);
  }
}

// ---- Reports ----

TEST(StressReport, MapsTakeCellsFromTheirFits) {
  StressReport report;
  report.axes = stress_axes(StressDensity::quick);
  report.task.lobes = grid_lobes(report.axes);
  for (std::size_t lobe = 0; lobe < report.task.lobes.size(); ++lobe)
    for (std::size_t start = 0; start < stress_starts().size(); ++start) {
      StressFit fit;
      fit.lobe = lobe;
      fit.start = start;
      fit.matrix = Eigen::Matrix3d::Identity();
      fit.ratio = lobe == 0 && start == 0 ? 2 : 1;
      report.run.fits.push_back(fit);
    }
  const picture::TiledMap success = success_map(report), ratio = ratio_map(report);
  const std::size_t cells = 2 * 3 * 3 * 3;
  ASSERT_EQ(success.values.size(), cells);
  ASSERT_EQ(ratio.values.size(), cells);
  EXPECT_FLOAT_EQ(success.values[0], 5.0f / 6) << "three own starts, two azimuths";
  EXPECT_EQ(ratio.values[0], 2);
  for (std::size_t i = 1; i < cells; ++i) {
    EXPECT_EQ(success.values[i], 1);
    EXPECT_EQ(ratio.values[i], 1);
  }
}

}  // namespace
}  // namespace ltc
