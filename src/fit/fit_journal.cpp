// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/fit_journal.h"

#include <algorithm>
#include <utility>

namespace ltc {
namespace {

bool is_finished(const FittedEntry& entry) {
  return entry.status != Status::skipped;
}

FittedEntry unfinished() {
  FittedEntry entry;
  entry.matrix.setZero();  // the same bytes in every file, whatever memory held
  return entry;
}

}  // namespace

FitJournal::FitJournal(std::size_t nodes, int sweeps) {
  for (int round = 0; round <= sweeps; ++round)  // each made in its place: they may be gigabytes
    finished_.rounds.emplace_back(nodes, unfinished());
}

FitJournal::FitJournal(FinishedFits finished) : finished_(std::move(finished)) {
  for (const std::vector<FittedEntry>& round : finished_.rounds)
    count_ += static_cast<std::size_t>(std::count_if(round.begin(), round.end(), is_finished));
}

bool FitJournal::recall(int round, std::size_t flat, FittedEntry& entry) const {
  const std::lock_guard lock(mutex_);
  const FittedEntry& found = finished_.rounds[static_cast<std::size_t>(round)][flat];
  if (!is_finished(found))
    return false;
  entry = found;
  return true;
}

void FitJournal::note(int round, std::size_t flat, const FittedEntry& entry) {
  const std::lock_guard lock(mutex_);
  FittedEntry& place = finished_.rounds[static_cast<std::size_t>(round)][flat];
  count_ += !is_finished(place) && is_finished(entry);
  place = entry;
}

std::size_t FitJournal::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

FinishedFits FitJournal::finished() const {
  const std::lock_guard lock(mutex_);
  return finished_;
}

}  // namespace ltc
