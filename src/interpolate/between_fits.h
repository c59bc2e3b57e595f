// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// All nodes of a big grid from fits of some of them: a lattice that is as dense along each axis as
// lobes ask for, fits at its nodes, cubic interpolation between them, and fits in the middles of
// its cells, which tell where that is not enough. Such cells are divided, and again, down to the
// nodes.
#pragma once

#include <cstddef>
#include <functional>

#include "core/run_context.h"
#include "fit/fit_table.h"
#include "interpolate/axis_probe.h"
#include "table/grid.h"

namespace ltc {

struct BetweenFitsSettings {
  ProbeSettings probe;
  double tolerance = 2e-2;  // of the excess in the middle of a cell
};

struct BetweenFitsReport {
  std::size_t fits = 0;          // lobes that were fitted
  std::size_t lattice_fits = 0;  // of these, for the axes and at the nodes of the first lattice
  LatticeAxes axes;              // of that
};

// About how many fits a grid takes, and bytes of memory beside what is stored.
std::size_t estimated_fits(const Grid& grid);
std::size_t between_fits_memory_bytes(const Grid& grid);

// Calls `store` once for each node, from any thread, with its aligned matrix: fitted (or analytic,
// or failed) as by fit_table, interpolated, or copied by symmetry as there. What is stored is a
// function of grid and settings alone. Throws Interrupted, and what `store` throws.
BetweenFitsReport fill_between_fits(const Grid& grid, const FitSettings& fit,
                                    const BetweenFitsSettings& settings, const RunContext& run,
                                    FitJournal* journal,
                                    const std::function<void(std::size_t, FittedEntry)>& store);

}  // namespace ltc
