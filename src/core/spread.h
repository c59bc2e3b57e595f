// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Independent work on all threads of all ranks (core/ranks.h). Ranks meet several times a second
// and tell each other what they have done since: then every rank has the results of all, progress
// counts them all, and a rank that fails or is asked to stop ends the others.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "core/parallel.h"
#include "core/ranks.h"
#include "core/run_context.h"

namespace ltc {

// Who does what: pieces that are kept are always those of the same rank, for it remembers something
// of each; others go to whoever has time.
enum class Spreading { kept, moving };

// The pieces of work that ranks have before them.
class RankShares {
 public:
  RankShares(Spreading spreading, std::size_t count, int ranks);

  bool all_done() const;
  // What a rank may do before the next meeting: piece(rank, i) for i in [0, left(rank)).
  std::size_t left(int rank) const;
  std::size_t piece(int rank, std::size_t i) const;
  // Each has done the first so many of these.
  void note_done(const std::vector<RankState>& states);

 private:
  void fill_window();

  Spreading spreading_;
  std::size_t count_, ranks_;
  std::vector<std::size_t> done_of_;  // kept: of each rank
  std::vector<std::size_t> window_;   // moving: the next pieces, dealt out in turn
  std::size_t next_ = 0;              // moving: the first beyond
  std::size_t share_;                 // moving: of the window, that of a rank
};

// How long ranks work between two meetings: enough pieces that they wait for each other's last ones
// a small part of it.
double seconds_until_meeting(const std::vector<RankState>& states);

// After a meeting: what each rank has done since becomes known to all, in turn. No rank may leave
// in the middle of it, for the others would wait for it: where memory is lacking, the process ends,
// and its launcher ends them all.
template <typename Visit, typename Heard>
void tell_done(Ranks& ranks, const RankShares& shares, const std::vector<RankState>& states,
               Visit& visit, Heard& heard) noexcept {
  std::vector<std::byte> bytes;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    const std::size_t done = states[static_cast<std::size_t>(rank)].done;
    const auto each_part = [&](auto&& take) {
      for (std::size_t i = 0; i < done; ++i)
        visit(shares.piece(rank, i), take);
    };
    std::size_t size = 0, at = 0;
    each_part([&](std::span<std::byte> part) { size += part.size(); });
    bytes.resize(size);
    const bool is_own = rank == ranks.rank();
    if (is_own)
      each_part([&](std::span<std::byte> part) {
        std::memcpy(bytes.data() + at, part.data(), part.size());
        at += part.size();
      });
    if (size > 0)
      ranks.broadcast(bytes, rank);
    if (is_own)
      continue;
    each_part([&](std::span<std::byte> part) {
      std::memcpy(part.data(), bytes.data() + at, part.size());
      at += part.size();
    });
    for (std::size_t i = 0; i < done; ++i)
      heard(shares.piece(rank, i));
  }
}

// Calls work(i, state) as parallel_for of i in [0, count), each i on one of the ranks. Afterwards
// all of them have the results: visit(i, take) calls take(bytes) for everything that work(i, ...)
// writes, as bytes_of; their sizes are the same on all ranks. `heard(i)` is called for each i that
// another rank did, once its results are there. Throws as parallel_for and meet.
template <typename State, typename MakeState, typename Work, typename Visit, typename Heard>
void spread_for(Spreading spreading, std::size_t count, const RunContext& run,
                MakeState&& make_state, Work&& work, Visit&& visit, Heard&& heard) {
  if (!run.ranks || run.ranks->size() == 1) {
    parallel_for<State>(count, run, make_state, work);
    return;
  }
  using Clock = std::chrono::steady_clock;
  Ranks& ranks = *run.ranks;
  const int own = ranks.rank();
  RankShares shares(spreading, count, ranks.size());
  std::vector<RankState> states(static_cast<std::size_t>(ranks.size()));
  while (!shares.all_done()) {
    const Clock::time_point began = Clock::now();
    const std::chrono::duration<double> most(seconds_until_meeting(states));
    RankState state;
    state.done = parallel_while<State>(
        shares.left(own), run, make_state,
        [&](std::size_t i, State& with) { work(shares.piece(own, i), with); },
        [&] { return Clock::now() - began < most; });
    const std::chrono::duration<double> passed = Clock::now() - began;
    state.seconds_a_piece =
        passed.count() * run.threads / static_cast<double>(std::max<std::size_t>(state.done, 1));
    states = meet(ranks, count, state);
    tell_done(ranks, shares, states, visit, heard);
    shares.note_done(states);
  }
}

// The same as a stage of its own, which counts, here and elsewhere.
template <typename State, typename MakeState, typename Work, typename Visit, typename Heard>
void spread_for_each(std::string_view stage, Spreading spreading, std::size_t count,
                     const RunContext& run, MakeState&& make_state, Work&& work, Visit&& visit,
                     Heard&& heard) {
  const Stage counted(run, stage, count);
  spread_for<State>(
      spreading, count, run, make_state,
      [&](std::size_t i, State& state) {
        work(i, state);
        run.advance();
      },
      visit,
      [&](std::size_t i) {
        heard(i);
        run.advance();
      });
}
template <typename State, typename MakeState, typename Work, typename Visit>
void spread_for_each(std::string_view stage, Spreading spreading, std::size_t count,
                     const RunContext& run, MakeState&& make_state, Work&& work, Visit&& visit) {
  spread_for_each<State>(stage, spreading, count, run, make_state, work, visit, [](std::size_t) {});
}

}  // namespace ltc
