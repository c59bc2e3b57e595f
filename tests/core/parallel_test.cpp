// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/parallel.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace ltc {
namespace {

class Watched final : public Progress {
 public:
  void begin_stage(std::string_view name, std::size_t units) override {
    stage = name;
    total = units;
  }
  void end_stage() override { ended = true; }
  std::string stage;
  std::size_t total = 0;
  bool ended = false;
};

const auto no_state = [] { return 0; };

// Work that only an exception or a stop can end. How much is done until then is for the schedule to
// say; that it ends is not.
constexpr std::size_t more_than_is_ever_done = std::numeric_limits<std::size_t>::max();

TEST(Parallel, DoesEveryPieceOfWorkOnce) {
  for (const int threads : {1, 2, 16}) {
    std::vector<int> done(1000, 0);
    std::atomic<int> states{0};
    Watched progress;
    parallel_for_each<int>(
        "work", done.size(), {threads, &progress}, [&] { return ++states; },
        [&](std::size_t i, int&) { ++done[i]; });
    EXPECT_EQ(done, std::vector<int>(1000, 1));
    EXPECT_EQ(states, threads);
    EXPECT_EQ(progress.done(), 1000u);
    EXPECT_EQ(progress.stage, "work");
    EXPECT_EQ(progress.total, 1000u);
    EXPECT_TRUE(progress.ended);
  }
}

TEST(Parallel, WorksWithoutAWatcherAndWithoutWork) {
  int done = 0;
  parallel_for_each<int>("none", 0, {2}, no_state, [&](std::size_t, int&) { ++done; });
  EXPECT_EQ(done, 0);
}

TEST(Parallel, PartsOfAStageAreDoneOnceAndNotCounted) {
  Watched progress;
  const RunContext run{2, &progress};
  const Stage stage(run, "work", 7);
  std::vector<int> done(1000, 0);
  parallel_for(done.size(), run, [&](std::size_t i) { ++done[i]; });
  parallel_for<int>(done.size(), run, no_state, [&](std::size_t i, int&) { ++done[i]; });
  EXPECT_EQ(done, std::vector<int>(1000, 2));
  EXPECT_EQ(progress.total, 7u);
  EXPECT_EQ(progress.done(), 0u);
  progress.request_stop();
  EXPECT_THROW(parallel_for(done.size(), run, [&](std::size_t i) { ++done[i]; }), Interrupted);
  EXPECT_THROW(
      parallel_for<int>(done.size(), run, no_state, [&](std::size_t i, int&) { ++done[i]; }),
      Interrupted);
  EXPECT_EQ(done, std::vector<int>(1000, 2));
}

TEST(Parallel, AnExceptionOfTheWorkArrivesAndEndsIt) {
  for (const int threads : {1, 2, 16}) {
    Watched progress;
    try {
      parallel_for_each<int>("work", more_than_is_ever_done, {threads, &progress}, no_state,
                             [&](std::size_t i, int&) {
                               if (i == 3)
                                 throw std::runtime_error("at 3");
                             });
      FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "at 3");
    }
    EXPECT_TRUE(progress.ended);
  }
}

// Whatever the schedule: a thread that failed takes no more work.
TEST(Parallel, AThreadFailsOnlyOnce) {
  for (const int threads : {1, 2, 16}) {
    std::atomic<int> failures{0};
    EXPECT_THROW(parallel_for_each<int>("work", 1000, {threads}, no_state,
                                        [&](std::size_t, int&) {
                                          ++failures;
                                          throw std::runtime_error("always");
                                        }),
                 std::runtime_error);
    EXPECT_GE(failures, 1);
    EXPECT_LE(failures, threads);
  }
}

TEST(Parallel, AnExceptionOfMakeStateArrives) {
  for (const int threads : {1, 2, 16}) {
    std::atomic<int> made{0};
    EXPECT_THROW(parallel_for_each<int>(
                     "work", 100, {threads},
                     [&]() -> int {
                       if (++made == 1)
                         throw std::out_of_range("no state");
                       return 0;
                     },
                     [](std::size_t, int&) {}),
                 std::out_of_range);
  }
}

TEST(Parallel, AStopIsThrownAsInterrupted) {
  for (const int threads : {1, 2, 16}) {
    Watched progress;
    EXPECT_THROW(
        parallel_for_each<int>("work", more_than_is_ever_done, {threads, &progress}, no_state,
                               [&](std::size_t i, int&) {
                                 if (i == 5)
                                   progress.request_stop();
                               }),
        Interrupted);
    EXPECT_TRUE(progress.ended);
  }
}

TEST(Parallel, AnExceptionComesBeforeAStop) {
  Watched progress;
  EXPECT_THROW(parallel_for_each<int>("work", 10, {2, &progress}, no_state,
                                      [&](std::size_t, int&) {
                                        progress.request_stop();
                                        throw std::runtime_error("failed");
                                      }),
               std::runtime_error);
}

}  // namespace
}  // namespace ltc
