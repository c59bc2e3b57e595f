// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/fit_journal.h"

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

FittedEntry FitRound::operator[](std::size_t flat) const {
  const auto found = finished_.find(flat);
  return found == finished_.end() ? unfinished() : found->second;
}

void FitRound::set(std::size_t flat, const FittedEntry& entry) {
  if (is_finished(entry))
    finished_.insert_or_assign(flat, entry);
  else
    finished_.erase(flat);
}

FitJournal::FitJournal(std::size_t nodes, int sweeps) {
  finished_.rounds.assign(static_cast<std::size_t>(sweeps) + 1, FitRound(nodes));
}

FitJournal::FitJournal(FinishedFits finished) : finished_(std::move(finished)) {}

bool FitJournal::recall(int round, std::size_t flat, FittedEntry& entry) const {
  const std::lock_guard lock(mutex_);
  const auto& finished = finished_.rounds[static_cast<std::size_t>(round)].finished();
  const auto found = finished.find(flat);
  if (found == finished.end())
    return false;
  entry = found->second;
  return true;
}

void FitJournal::note(int round, std::size_t flat, const FittedEntry& entry) {
  const std::lock_guard lock(mutex_);
  finished_.rounds[static_cast<std::size_t>(round)].set(flat, entry);
}

std::size_t FitJournal::count() const {
  const std::lock_guard lock(mutex_);
  std::size_t count = 0;
  for (const FitRound& round : finished_.rounds)
    count += round.finished().size();
  return count;
}

FinishedFits FitJournal::finished() const {
  const std::lock_guard lock(mutex_);
  return finished_;
}

}  // namespace ltc
