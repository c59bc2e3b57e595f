// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Fits every entry of a grid that symmetry leaves to be fitted, on all threads.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/progress.h"
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
};

// One entry a node of `grid`, in its order; those that are not `needed` stay skipped. Entries that
// share a lobe with another are copied, and turned where need be, from it. With sweeps, every
// fitted entry then tries its grid neighbours' solutions as starts and keeps the better one; all
// entries of a sweep see the same state, so that neither order nor the number of threads matters.
// Throws Interrupted when `progress` (which may be null) asks for a stop.
std::vector<FittedEntry> fit_table(const Grid& grid, const FitSettings& settings,
                                   const std::vector<bool>& needed, int threads,
                                   Progress* progress);

// All of them.
std::vector<FittedEntry> fit_table(const Grid& grid, const FitSettings& settings, int threads,
                                   Progress* progress);

// The solutions of an entry's neighbours along the four axes, carried over into its own frame: what
// changes slowly from node to node is P, not M. Neighbours without values are left out.
std::vector<Eigen::Matrix3d> neighbour_starts(const Grid& grid, std::size_t flat,
                                              const std::vector<FittedEntry>& entries);

// The seed of everything random about one entry's fit; `representative` is that of the whole grid's
// plan, so that an entry is fitted alike whatever else is needed.
std::uint64_t entry_seed(std::uint64_t seed, std::size_t representative);

}  // namespace ltc
