// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Fits every entry of a grid that symmetry leaves to be fitted, on all threads of all ranks.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/run_context.h"
#include "fit/settings.h"
#include "fit/solver.h"
#include "fit/symmetry_plan.h"
#include "table/table.h"

namespace ltc {

struct FittedEntry {
  Eigen::Matrix3d matrix;  // M, as the solver left it; NaN where skipped or failed
  double loss = 0;
  int steps = 0;
  Status status = Status::skipped;
  Fold fold = {};  // before the matrix, of solvers of folded lobes
};

// One fit of an entry, for those who want to watch: its own, then one for every sweep.
struct WatchedFit {
  int sweep = 0;               // 0 for the entry's own fit
  std::size_t neighbours = 0;  // whose solutions the sweep had to offer
  std::vector<FitStep> steps;  // none where a sweep's offers promised nothing
  bool improved = true;        // whether the entry took the result
};
struct FitWatch {
  std::size_t entry = 0;  // flat index; one that is fitted, not copied
  std::vector<WatchedFit> fits;
};

class FitJournal;  // fit/fit_journal.h

// One entry a node of `grid`, in its order; those that `plan` leaves out stay skipped. Entries that
// share a lobe with another are copied, and turned where need be, from it. With sweeps, every
// fitted entry then tries its grid neighbours' solutions as starts and keeps the better one; all
// entries of a sweep see the same state, so that neither order nor the number of threads matters.
// Throws Interrupted when a stop is asked for, InputError for settings with a fold. `watch`, where
// not null, gets the steps of its entry. `journal`, where not null, spares the fits that it knows
// and learns of the others as they are finished; of several ranks the first one's.
std::vector<FittedEntry> fit_table(const Grid& grid, const FitSettings& settings,
                                   const std::vector<PlannedEntry>& plan, const RunContext& run,
                                   FitWatch* watch = nullptr, FitJournal* journal = nullptr);

// By the plan of these entries.
std::vector<FittedEntry> fit_table(const Grid& grid, const FitSettings& settings,
                                   const std::vector<bool>& needed, const RunContext& run,
                                   FitWatch* watch = nullptr, FitJournal* journal = nullptr);

// Seen from above, an isotropic lobe is round; its fit is but for the noise of its samples.
Eigen::Matrix3d rounded_to_symmetry(const Lobe& lobe, Eigen::Matrix3d matrix);

// Gives every entry that has another one as its representative that one's matrix, turned.
void copy_by_symmetry(const std::vector<PlannedEntry>& plan, const RunContext& run,
                      std::vector<FittedEntry>& entries);

// One of several parts of a table's own fits, which are made apart: number in [1, count].
struct Shard {
  int number = 1, count = 1;
};
inline constexpr int most_shards = 100000;

// The fits of a shard: those of every count-th entry, in an order that takes from everywhere.
std::vector<std::size_t> entries_of_shard(const std::vector<PlannedEntry>& plan,
                                          const Shard& shard);

// Makes them, as round 0 of fit_table would. `journal` as there. Throws as fit_table.
void fit_shard(const Grid& grid, const FitSettings& settings, const std::vector<PlannedEntry>& plan,
               const Shard& shard, const RunContext& run, FitJournal* journal);

// How many sweeps the settings ask for: none but with the solver that has them.
int sweep_count(const FitSettings& settings);

// What every entry of a table goes through: fits the request's lobe and stores the result, its
// steps added to those that `entry` has. `trace` may be null.
FitResult fit_entry(const Solver& solver, const FitRequest& request, FitWorkspace& workspace,
                    std::vector<FitStep>* trace, FittedEntry& entry);

// The solutions of an entry's neighbours along the four axes, carried over into its own frame: what
// changes slowly from node to node is P, not M. Neighbours without values are left out.
std::vector<Eigen::Matrix3d> neighbour_starts(const Grid& grid, std::size_t flat,
                                              const std::vector<FittedEntry>& entries);

// The seed of everything random about one entry's fit; `representative` is that of the whole grid's
// plan, so that an entry is fitted alike whatever else is needed.
std::uint64_t entry_seed(std::uint64_t seed, std::size_t representative);

}  // namespace ltc
