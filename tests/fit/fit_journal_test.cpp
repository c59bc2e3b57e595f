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
  return fit_table(grid, quick_settings(), needed, 2, progress, nullptr, journal);
}

// The journal of a whole run.
FinishedFits all_fits() {
  FitJournal journal(grid.size(), sweeps);
  fit(&journal);
  return journal.finished();
}

// Asks for a stop once so many units of work are done, all stages together.
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
    for (std::vector<FittedEntry>& round : part.rounds)
      for (FittedEntry& entry : round)
        if (random.uniform() >= share)
          entry.status = Status::skipped;
    FitJournal journal(part);
    EXPECT_TRUE(same_bits(fit(&journal), undisturbed));
    EXPECT_EQ(journal.count(), FitJournal(all).count());
  }
}

TEST(FitJournal, StoppedAnywhereAndGoneOnMakesTheSameTable) {
  const std::vector<FittedEntry> undisturbed = fit(nullptr);
  const std::size_t all = FitJournal(all_fits()).count();
  int stopped = 0;
  for (std::size_t units = 1; units < all; units += all / 7) {
    SCOPED_TRACE(units);
    FitJournal journal(grid.size(), sweeps);
    try {
      StopAfter progress(units);
      fit(&journal, &progress);
    } catch (const Interrupted&) {
      ++stopped;  // a late one may come too late
    }
    EXPECT_GE(journal.count(), units);
    EXPECT_TRUE(same_bits(fit(&journal), undisturbed));
  }
  EXPECT_GT(stopped, 0);
}

// The tests above would pass if nothing were ever recalled.
TEST(FitJournal, WhatItKnowsIsNotFittedAgain) {
  FinishedFits all = all_fits();
  std::size_t planted = 0;
  while (all.rounds.back().at(planted).status != Status::fitted)
    ++planted;
  all.rounds.back()[planted].loss = 12345;
  FitJournal journal(all);
  EXPECT_EQ(fit(&journal)[planted].loss, 12345);
}

}  // namespace
}  // namespace ltc
