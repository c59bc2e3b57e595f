// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The journal of fits: a run that was cut short and goes on makes the table of one that was not.
#include "fit/fit_journal.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/random.h"
#include "fit/same_fits.h"

namespace ltc {
namespace {

using test::same_bits;

constexpr int sweeps = 2;

// Two sweeps, each of which depends on all of the round before it.
FitSettings quick_settings() {
  FitSettings settings;
  settings.gauss_newton.samples = 128;
  settings.gauss_newton.directions = 8;
  settings.gauss_newton.target_samples = 256;
  settings.gauss_newton.coarse_samples = 64;
  settings.gauss_newton.steps = 2;
  settings.gauss_newton.neighbour_sweeps = sweeps;
  return settings;
}

const Grid grid = Grid::paper(3);

std::vector<FittedEntry> fit(FitJournal* journal, Progress* progress = nullptr) {
  const std::vector<bool> needed(grid.size(), true);
  return fit_table(grid, quick_settings(), needed, {2, progress}, nullptr, journal);
}

// The journal of a whole run.
FinishedFits all_fits() {
  FitJournal journal(grid.size(), sweeps);
  fit(&journal);
  return journal.finished();
}

// Asks for a stop as a stage begins, before any of its work is done.
class StopAtStage final : public Progress {
 public:
  explicit StopAtStage(std::size_t stage) : stages_left_(stage) {}
  void begin_stage(std::string_view, std::size_t) override {
    if (--stages_left_ == 0)
      request_stop();
  }
  void end_stage() override {}

 private:
  std::size_t stages_left_;
};

// Asks for a stop once so many units of work are done, all stages together, or some time after.
class StopAfter final : public Progress {
 public:
  explicit StopAfter(std::size_t units) : units_(units), watcher_([this] { watch(); }) {}
  ~StopAfter() override {
    ended_ = true;
    watcher_.join();
  }
  void begin_stage(std::string_view, std::size_t) override {}
  void end_stage() override {}

 private:
  void watch() {
    while (!ended_ && done() < units_)
      std::this_thread::yield();
    request_stop();
  }
  const std::size_t units_;
  std::atomic<bool> ended_{false};
  std::thread watcher_;
};

TEST(FitJournal, LearnsOfEveryFitThatIsDone) {
  FitJournal journal(grid.size(), sweeps);
  EXPECT_EQ(journal.count(), 0u);
  const std::vector<FittedEntry> entries = fit(&journal);
  const FinishedFits fits = journal.finished();
  ASSERT_EQ(fits.rounds.size(), 1u + sweeps);
  std::size_t fitted = 0, count = 0;
  for (std::size_t flat = 0; flat < entries.size(); ++flat) {
    const Status status = entries[flat].status;
    fitted += status == Status::fitted;
    for (std::size_t round = 0; round < fits.rounds.size(); ++round) {
      const bool finished = fits.rounds[round][flat].status != Status::skipped;
      const bool expected = status == Status::fitted || (status == Status::analytic && round == 0);
      EXPECT_EQ(finished, expected) << "round " << round << ", entry " << flat;
      count += finished;
    }
    if (status == Status::fitted) {
      EXPECT_TRUE(same_bits(fits.rounds.back()[flat], entries[flat])) << flat;
    }
  }
  EXPECT_GT(fitted, 10u);
  EXPECT_EQ(journal.count(), count);
}

TEST(FitJournal, AnyPartOfARunMakesTheSameTable) {
  const std::vector<FittedEntry> undisturbed = fit(nullptr);
  const FinishedFits all = all_fits();
  Random random(4);
  for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    SCOPED_TRACE(share);
    FinishedFits part = all;
    for (FitRound& round : part.rounds)
      for (std::size_t flat = 0; flat < round.size(); ++flat)
        if (random.uniform() >= share)
          round.set(flat, {});
    FitJournal journal(part);
    EXPECT_TRUE(same_bits(fit(&journal), undisturbed));
    EXPECT_EQ(journal.count(), FitJournal(all).count());
  }
}

// The fits of the first so many rounds.
std::size_t count_in_rounds(const FinishedFits& fits, std::size_t rounds) {
  std::size_t count = 0;
  for (std::size_t round = 0; round < rounds; ++round)
    count += fits.rounds[round].finished().size();
  return count;
}

TEST(FitJournal, StoppedBetweenStagesAndGoneOnMakesTheSameTable) {
  const std::vector<FittedEntry> undisturbed = fit(nullptr);
  const FinishedFits all = all_fits();
  for (std::size_t stage = 1; stage <= 1u + sweeps; ++stage) {
    SCOPED_TRACE(stage);
    FitJournal journal(grid.size(), sweeps);
    StopAtStage progress(stage);
    EXPECT_THROW(fit(&journal, &progress), Interrupted);
    EXPECT_EQ(journal.count(), count_in_rounds(all, stage - 1));
    EXPECT_TRUE(same_bits(fit(&journal), undisturbed));
  }
}

// Where it stops, and whether before its end, is for the schedule to say; what comes of it is not.
TEST(FitJournal, StoppedAnywhereAndGoneOnMakesTheSameTable) {
  const std::vector<FittedEntry> undisturbed = fit(nullptr);
  const std::size_t all = FitJournal(all_fits()).count();
  for (std::size_t units = 1; units < all; units += all / 7) {
    SCOPED_TRACE(units);
    FitJournal journal(grid.size(), sweeps);
    try {
      StopAfter progress(units);
      fit(&journal, &progress);
    } catch (const Interrupted&) {
    }
    EXPECT_GE(journal.count(), units);
    EXPECT_TRUE(same_bits(fit(&journal), undisturbed));
  }
}

// The tests above would pass if nothing were ever recalled.
TEST(FitJournal, WhatItKnowsIsNotFittedAgain) {
  FinishedFits all = all_fits();
  std::size_t planted = 0;
  while (all.rounds.back()[planted].status != Status::fitted)
    ++planted;
  FittedEntry entry = all.rounds.back()[planted];
  entry.loss = 12345;
  all.rounds.back().set(planted, entry);
  FitJournal journal(all);
  EXPECT_EQ(fit(&journal)[planted].loss, 12345);
}

}  // namespace
}  // namespace ltc
