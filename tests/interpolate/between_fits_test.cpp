// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "interpolate/between_fits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "../fit/same_fits.h"
#include "align/align.h"
#include "core/error.h"
#include "fit/fit_journal.h"
#include "interpolate/node_fits.h"
#include "judge/held_out.h"

namespace ltc {
namespace {

using test::same_bits;

// Smooth lobes along one long axis; the last lambda is isotropic, the first theta looks upward.
const Grid grid = [] {
  Grid g;
  g.alpha = Axis::make(0.3, 0.5, 2, Warp::linear);
  g.lambda = Axis::make(0.5, 1, 2, Warp::linear);
  g.theta = Axis::make(0, 1.2, 49, Warp::linear);
  g.phi = Axis::make(0, std::numbers::pi / 2, 3, Warp::linear);
  return g;
}();

FitSettings quick_fit() {
  FitSettings settings;
  settings.gauss_newton.samples = 1024;
  settings.gauss_newton.target_samples = 2048;
  return settings;
}

BetweenFitsSettings few_lines() {
  BetweenFitsSettings settings;
  settings.probe.lines = 4;
  return settings;
}

struct Filled {
  std::vector<FittedEntry> entries;
  BetweenFitsReport report;
};
Filled fill(const RunContext& run, FitJournal* journal = nullptr,
            const BetweenFitsSettings& settings = few_lines()) {
  Filled filled;
  filled.entries.resize(grid.size());
  filled.report = fill_between_fits(
      grid, quick_fit(), settings, run, journal,
      [&](std::size_t flat, const FittedEntry& entry) { filled.entries[flat] = entry; });
  return filled;
}

const Filled& filled() {
  static const Filled once = fill({2});
  return once;
}

const std::vector<FittedEntry>& own_fits() {
  static const std::vector<FittedEntry> entries = [] {
    std::vector<FittedEntry> all =
        fit_table(grid, quick_fit(), std::vector<bool>(grid.size(), true), {2});
    for (FittedEntry& entry : all)
      entry.matrix = align(entry.matrix);
    return all;
  }();
  return entries;
}

std::size_t count(const std::vector<FittedEntry>& entries, Status status) {
  return static_cast<std::size_t>(std::ranges::count(entries, status, &FittedEntry::status));
}

// Fits of so few samples are themselves 2 % from the best.
void expect_as_good_as_own_fits(const std::vector<FittedEntry>& entries, Status status) {
  HeldOutJudge judge(4096, 32);
  double sum = 0;
  std::size_t judged = 0;
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    if (entries[flat].status != status)
      continue;
    const PairJudgement judgement = judge.judge_pair(grid.lobe(flat), LtcLobe(entries[flat].matrix),
                                                     LtcLobe(own_fits()[flat].matrix));
    const double ratio = judgement.loss_a / judgement.loss_b;
    EXPECT_LT(ratio, 1.02) << flat;
    EXPECT_NEAR(entries[flat].loss / own_fits()[flat].loss, 1, 0.1) << flat;
    sum += ratio;
    ++judged;
  }
  ASSERT_GT(judged, 0u);
  EXPECT_LT(sum / static_cast<double>(judged), 1.003);
}

TEST(BetweenFits, FitsFew) {
  const auto& [entries, report] = filled();
  EXPECT_LT(report.fits, EqualLobes(grid).count() * 2 / 3);
  EXPECT_GT(count(entries, Status::interpolated), grid.size() / 5);
  EXPECT_EQ(count(entries, Status::copied), count(own_fits(), Status::copied));
  expect_as_good_as_own_fits(entries, Status::fitted);
}

TEST(BetweenFits, WhatLiesBetweenIsAsGoodAsFitsOfItsOwn) {
  expect_as_good_as_own_fits(filled().entries, Status::interpolated);
}

TEST(BetweenFits, SymmetryStands) {
  const auto& entries = filled().entries;
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const NodeIndex at = grid.node(flat);
    const std::size_t first = EqualLobes(grid).first_of(flat);
    if (at.theta == 0) {
      EXPECT_EQ(entries[flat].matrix, entries[first].matrix) << flat;
    } else if (at.lambda == 1) {
      // Turned, and aligned anew: within what a pass of alignment leaves.
      EXPECT_LT(
          (entries[flat].matrix - turned(entries[first].matrix, grid.phi.nodes[at.phi])).norm(),
          1e-3)
          << flat;
    }
  }
}

TEST(BetweenFits, CellsThatFailAreFitted) {
  BetweenFitsSettings strict = few_lines();
  strict.tolerance = -1;  // no excess is below
  const Filled all = fill({2}, nullptr, strict);
  EXPECT_EQ(count(all.entries, Status::interpolated), 0u);
  EXPECT_EQ(all.report.fits, EqualLobes(grid).count());
  expect_as_good_as_own_fits(all.entries, Status::fitted);
}

TEST(NodeFits, StartFromWhatIsNear) {
  const FitSettings settings = quick_fit();
  NodeFits fits(grid, settings, {1}, nullptr);
  const std::size_t flat = grid.flat({0, 0, 30, 1});
  const FitWorkspacePointer workspace = make_fit_workspace();
  const FittedEntry own = fits.fit_alone(flat, *workspace);
  const NodeValues values = values_of(grid.lobe(flat), align(own.matrix), own.loss);
  NodeValues near = values;
  near[0] *= 1.02;
  const FittedEntry from_near = fits.fit_alone(flat, *workspace, &near);
  EXPECT_LT(from_near.steps, own.steps / 2);
  EXPECT_NEAR(from_near.loss / own.loss, 1, 2e-3);
  // What ends far above the loss that others tell of is fitted anew.
  near[9] -= 1;
  EXPECT_LE(fits.fit_alone(flat, *workspace, &near).loss, own.loss);
  near = -values;
  EXPECT_TRUE(same_bits(fits.fit_alone(flat, *workspace, &near), own));
}

TEST(BetweenFits, SameBitsWithAnyNumberOfThreads) {
  EXPECT_TRUE(same_bits(fill({1}).entries, fill({3}).entries));
}

TEST(BetweenFits, GoesOnFromItsJournal) {
  FitJournal whole(grid.size(), 0);
  EXPECT_TRUE(same_bits(fill({2}, &whole).entries, filled().entries));
  EXPECT_EQ(whole.count(), filled().report.fits);
  FinishedFits half = whole.finished();
  for (std::size_t flat = 0; flat < grid.size(); flat += 2)
    half.rounds[0].set(flat, {});
  FitJournal journal(half);
  EXPECT_TRUE(same_bits(fill({2}, &journal).entries, filled().entries));
  // And would not if nothing were recalled.
  auto [flat, planted] = *half.rounds[0].finished().begin();
  planted.loss = 12345;
  half.rounds[0].set(flat, planted);
  FitJournal wrong(half);
  EXPECT_EQ(fill({2}, &wrong).entries[flat].loss, 12345);
}

TEST(BetweenFits, EndsWhenAskedTo) {
  StopOnly progress;
  progress.request_stop();
  EXPECT_THROW(fill({2, &progress}), Interrupted);
}

TEST(BetweenFits, EstimatesNoMoreFitsThanLobes) {
  EXPECT_EQ(estimated_fits(Grid::paper(8)), EqualLobes(Grid::paper(8)).count());
  EXPECT_LT(estimated_fits(Grid::paper(32)), EqualLobes(Grid::paper(32)).count() / 8);
  EXPECT_GT(between_fits_memory_bytes(Grid::paper(32)), std::size_t{1} << 20);
}

}  // namespace
}  // namespace ltc
