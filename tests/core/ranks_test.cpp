// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/ranks.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/spread.h"
#include "support/fake_ranks.h"

namespace ltc {
namespace {

using test::as_ranks;

const auto no_state = [] { return 0; };
constexpr int interrupted = 130;

// Of every rank: what it found.
template <typename Value, typename Work>
std::vector<Value> of_ranks(int size, Work&& work) {
  std::vector<Value> found(static_cast<std::size_t>(size));
  as_ranks(size,
           [&](Ranks& ranks) { found[static_cast<std::size_t>(ranks.rank())] = work(ranks); });
  return found;
}

// ---- Work that is spread ----

struct Result {
  std::vector<double> values;
  std::vector<int> done_here;
  std::vector<int> heard;
  std::size_t counted = 0;
};

Result squares(std::size_t count, Spreading spreading, const RunContext& run) {
  Result result{std::vector<double>(count), std::vector<int>(count), std::vector<int>(count)};
  spread_for_each<int>(
      "work", spreading, count, run, no_state,
      [&](std::size_t i, int) {
        result.values[i] = static_cast<double>(i * i);
        ++result.done_here[i];
      },
      [&](std::size_t i, auto&& take) { take(bytes_of(result.values[i])); },
      [&](std::size_t i) { ++result.heard[i]; });
  result.counted = run.progress ? run.progress->done() : 0;
  return result;
}

TEST(Spread, EachPieceIsDoneOnceAndKnownToAll) {
  for (const Spreading spreading : {Spreading::kept, Spreading::moving})
    for (const int size : {1, 2, 3, 5})
      for (const std::size_t count :
           {std::size_t{0}, std::size_t{1}, std::size_t{4}, std::size_t{1000}}) {
        const std::vector<Result> results = of_ranks<Result>(size, [&](Ranks& ranks) {
          StopOnly progress;
          return squares(count, spreading, {2, &progress, &ranks});
        });
        const Result alone = squares(count, spreading, {2});
        for (std::size_t i = 0; i < count; ++i) {
          int done = 0;
          for (const Result& result : results) {
            done += result.done_here[i];
            // Done here or heard of, never both.
            EXPECT_EQ(result.done_here[i] + result.heard[i], 1);
          }
          EXPECT_EQ(done, 1);
        }
        for (const Result& result : results) {
          EXPECT_EQ(result.values, alone.values);
          EXPECT_EQ(result.counted, count);
        }
      }
}

TEST(Spread, KeptPiecesStayWithTheirRanks) {
  const std::vector<Result> results = of_ranks<Result>(3, [&](Ranks& ranks) {
    return squares(100, Spreading::kept, {1, nullptr, &ranks});
  });
  for (std::size_t i = 0; i < 100; ++i)
    EXPECT_EQ(results[i % 3].done_here[i], 1) << i;
}

// Ranks of unequal pace: what one leaves undone another takes.
TEST(RankShares, WhatIsLeftIsDealtOutAnew) {
  RankShares shares(Spreading::moving, 1000, 2);
  std::vector<int> done(1000);
  std::size_t of_first = 0;
  while (!shares.all_done()) {
    const std::size_t first = std::min<std::size_t>(shares.left(0), 90),
                      second = std::min<std::size_t>(shares.left(1), 10);
    for (std::size_t i = 0; i < first; ++i)
      ++done[shares.piece(0, i)];
    for (std::size_t i = 0; i < second; ++i)
      ++done[shares.piece(1, i)];
    of_first += first;
    shares.note_done({{first, 0}, {second, 0}});
  }
  EXPECT_EQ(done, std::vector<int>(1000, 1));
  // Nine tenths, but for the first window, which is dealt out evenly and not worked off at once.
  EXPECT_GT(of_first, 800u);
}

TEST(RankShares, NothingIsLeftOfAnyCount) {
  for (const Spreading spreading : {Spreading::kept, Spreading::moving})
    for (std::size_t count = 0; count < 300; count += 7) {
      RankShares shares(spreading, count, 4);
      std::vector<int> done(count);
      while (!shares.all_done()) {
        std::vector<RankState> states;
        for (int rank = 0; rank < 4; ++rank) {
          for (std::size_t i = 0; i < shares.left(rank); ++i)
            ++done[shares.piece(rank, i)];
          states.push_back({shares.left(rank), 0});
        }
        shares.note_done(states);
      }
      EXPECT_EQ(done, std::vector<int>(count, 1));
    }
}

TEST(Spread, RanksMeetMoreRarelyWherePiecesTakeLong) {
  const double soon = seconds_until_meeting({{10, 1e-4}, {10, 1e-5}});
  EXPECT_LE(soon, 0.5);  // a stop is heard of within a second
  EXPECT_EQ(seconds_until_meeting({{1, 1e-4}, {1, 45}}), 180);
}

// How a rank ended: "" where it did its work.
std::string outcome(Ranks& ranks, const std::function<void()>& work) {
  RankEnd end;
  try {
    work();
  } catch (const Interrupted& error) {
    end = {interrupted, error.what()};
  } catch (const IoError& error) {
    end = {3, error.what()};
  } catch (const std::exception& error) {
    end = {1, error.what()};
  }
  end = agree_on_end(ranks, end, interrupted);
  return std::to_string(end.exit_code) + " " + end.message;
}

TEST(Spread, TheErrorOfOneRankEndsAll) {
  for (const int failing : {0, 2}) {
    const auto ends = of_ranks<std::string>(3, [&](Ranks& ranks) {
      return outcome(ranks, [&] {
        std::vector<double> values(1000);
        spread_for<int>(
            Spreading::moving, values.size(), {2, nullptr, &ranks}, no_state,
            [&](std::size_t, int) {
              if (ranks.rank() == failing)
                throw IoError("disk full");
            },
            [&](std::size_t i, auto&& take) { take(bytes_of(values[i])); }, [](std::size_t) {});
      });
    });
    EXPECT_EQ(ends, std::vector<std::string>(3, "3 disk full"));
  }
}

TEST(Spread, AStopOfOneRankEndsAll) {
  const auto ends = of_ranks<std::string>(3, [&](Ranks& ranks) {
    return outcome(ranks, [&] {
      StopOnly progress;
      if (ranks.rank() == 1)
        progress.request_stop();
      squares(1000, Spreading::kept, {2, &progress, &ranks});
    });
  });
  EXPECT_EQ(ends, std::vector<std::string>(3, "130 interrupted; nothing was written"));
}

TEST(Spread, RanksAtDifferentWorkAreToldApart) {
  const auto ends = of_ranks<std::string>(2, [&](Ranks& ranks) {
    return outcome(ranks, [&] {
      squares(ranks.rank() == 0 ? 10 : 11, Spreading::kept, {1, nullptr, &ranks});
    });
  });
  EXPECT_EQ(ends, std::vector<std::string>(
                      2, "1 ranks are at different work: rank 1 has 11 pieces, rank 0 10"));
}

// ---- What is shared ----

TEST(Ranks, TheFirstOnesTextIsThatOfAll) {
  for (const std::string& text : {std::string(), std::string("a\0b", 3), std::string(10000, 'x')})
    EXPECT_EQ(of_ranks<std::string>(4,
                                    [&](Ranks& ranks) {
                                      std::string own = ranks.rank() == 0 ? text : "of another";
                                      share_from_first(&ranks, own);
                                      return own;
                                    }),
              std::vector<std::string>(4, text));
  std::string alone = "kept";
  share_from_first(nullptr, alone);
  EXPECT_EQ(alone, "kept");
}

TEST(Ranks, WhatDiffersIsNamed) {
  const auto end_with = [](const std::string& of_last) {
    return of_ranks<std::string>(3, [&](Ranks& ranks) {
      return outcome(ranks,
                     [&] { require_same(&ranks, "config", ranks.rank() == 2 ? of_last : "a"); });
    });
  };
  EXPECT_EQ(end_with("a"), std::vector<std::string>(3, "0 "));
  EXPECT_EQ(end_with("b"), std::vector<std::string>(
                               3, "1 config: rank 2 has another than rank 0; expected the same"));
  EXPECT_NO_THROW(require_same(nullptr, "config", "a"));
}

TEST(Ranks, ValuesComeBackFromTheirBytes) {
  double number = 0.1, back = 0;
  std::string text = "x";
  append_bytes(number, text);
  EXPECT_EQ(take_bytes(text, 1, back), sizeof(double));
  EXPECT_EQ(back, number);
}

// ---- The end ----

std::string agreed(const std::vector<RankEnd>& ends) {
  const auto all = of_ranks<std::string>(static_cast<int>(ends.size()), [&](Ranks& ranks) {
    const RankEnd end =
        agree_on_end(ranks, ends[static_cast<std::size_t>(ranks.rank())], interrupted);
    return std::to_string(end.exit_code) + " " + end.message;
  });
  EXPECT_EQ(all, std::vector<std::string>(ends.size(), all[0]));
  return all[0];
}

TEST(Ranks, TheEndOfAllIsThatOfTheLowestThatFailed) {
  const RankEnd done, stop{interrupted, "stop"}, disk{3, "disk"}, input{2, "input"};
  EXPECT_EQ(agreed({done, done}), "0 ");
  EXPECT_EQ(agreed({stop, disk, input}), "3 disk");
  EXPECT_EQ(agreed({input, disk, stop}), "2 input");
  EXPECT_EQ(agreed({stop, {interrupted, "another stop"}}), "130 stop");
  // Written is written.
  EXPECT_EQ(agreed({done, stop, disk}), "0 ");
  EXPECT_EQ(agreed({disk, done}), "3 disk");
}

}  // namespace
}  // namespace ltc
