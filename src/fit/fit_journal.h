// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Which fits of a table are finished, so that a run that was cut short can go on where it stood.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <vector>

#include "fit/fit_table.h"

namespace ltc {

// Those of one round: one entry a node of a grid, `skipped` where its fit is not finished (or not
// needed). Only what is finished takes room: of a big table that is little.
class FitRound {
 public:
  explicit FitRound(std::size_t nodes = 0) : nodes_(nodes) {}

  std::size_t size() const { return nodes_; }
  FittedEntry operator[](std::size_t flat) const;
  void set(std::size_t flat, const FittedEntry& entry);
  const std::map<std::size_t, FittedEntry>& finished() const { return finished_; }

 private:
  std::size_t nodes_;
  std::map<std::size_t, FittedEntry> finished_;
};

// The finished fits of fit_table. Round 0 is the entries' own fits, round n the nth sweep.
struct FinishedFits {
  std::vector<FitRound> rounds;
};

// What fit_table writes down while it works and looks up before it works. A fit is a function of
// its request alone, so fits recalled and fits done anew make the same table, bit for bit. All
// functions may be called from any thread.
class FitJournal {
 public:
  // With nothing finished, for a grid of `nodes` and fits of 1 + `sweeps` rounds.
  FitJournal(std::size_t nodes, int sweeps);
  // With what an earlier run has finished.
  explicit FitJournal(FinishedFits finished);

  // Whether the fit is finished; if so, `entry` becomes its result.
  bool recall(int round, std::size_t flat, FittedEntry& entry) const;
  // A fit is finished: its entry is not `skipped`.
  void note(int round, std::size_t flat, const FittedEntry& entry);

  // How many fits are finished, all rounds together.
  std::size_t count() const;
  // A copy of all of them at one moment.
  FinishedFits finished() const;

 private:
  mutable std::mutex mutex_;
  FinishedFits finished_;
};

}  // namespace ltc
