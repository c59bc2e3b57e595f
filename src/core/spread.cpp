// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/spread.h"

#include <numeric>

namespace ltc {
namespace {

// Of one rank, to begin with: hardly a second of any work, and few enough to be dealt out anew.
constexpr std::size_t first_share = 64;

// Short enough that a stop is heard everywhere within a second.
constexpr double least_seconds = 0.2;
// Where a piece takes long: then the last ones of the threads end at different times.
constexpr double least_pieces = 4;

}  // namespace

RankShares::RankShares(Spreading spreading, std::size_t count, int ranks)
    : spreading_(spreading),
      count_(count),
      ranks_(static_cast<std::size_t>(ranks)),
      done_of_(spreading == Spreading::kept ? ranks_ : 0),
      share_(first_share) {
  if (spreading_ == Spreading::moving)
    fill_window();
}

void RankShares::fill_window() {
  const std::size_t more =
      std::min(count_ - next_, ranks_ * share_ - std::min(ranks_ * share_, window_.size()));
  const std::size_t before = window_.size();
  window_.resize(before + more);
  std::iota(window_.begin() + static_cast<std::ptrdiff_t>(before), window_.end(), next_);
  next_ += more;
}

bool RankShares::all_done() const {
  if (spreading_ == Spreading::moving)
    return window_.empty();
  return std::accumulate(done_of_.begin(), done_of_.end(), std::size_t{0}) == count_;
}

std::size_t RankShares::left(int rank) const {
  const auto r = static_cast<std::size_t>(rank);
  const std::size_t all = spreading_ == Spreading::moving ? window_.size() : count_;
  const std::size_t of_rank = r < all ? (all - r - 1) / ranks_ + 1 : 0;
  return spreading_ == Spreading::moving ? of_rank : of_rank - done_of_[r];
}

std::size_t RankShares::piece(int rank, std::size_t i) const {
  const auto r = static_cast<std::size_t>(rank);
  return spreading_ == Spreading::moving ? window_[r + ranks_ * i] : r + ranks_ * (done_of_[r] + i);
}

void RankShares::note_done(const std::vector<RankState>& states) {
  if (spreading_ == Spreading::kept) {
    for (std::size_t rank = 0; rank < ranks_; ++rank)
      done_of_[rank] += states[rank].done;
    return;
  }
  bool was_too_small = false;
  for (std::size_t rank = 0; rank < ranks_; ++rank)
    was_too_small = was_too_small || (states[rank].done == left(static_cast<int>(rank)));
  std::vector<std::size_t> rest;
  for (std::size_t at = 0; at < window_.size(); ++at)
    if (at / ranks_ >= states[at % ranks_].done)
      rest.push_back(window_[at]);
  window_ = std::move(rest);
  if (was_too_small)
    share_ *= 2;
  fill_window();
}

double seconds_until_meeting(const std::vector<RankState>& states) {
  double longest = 0;
  for (const RankState& state : states)
    longest = std::max(longest, state.seconds_a_piece);
  return std::max(least_seconds, least_pieces * longest);
}

}  // namespace ltc
