// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The matrices of a whole grid in closed form, for a refinement to begin with: nothing is fitted
// that it would move anyway.
#pragma once

#include <vector>

#include "core/run_context.h"
#include "fit/fit_table.h"
#include "fit/symmetry_plan.h"
#include "table/grid.h"

namespace ltc {

// As fit_table (fit/fit_table.h), but each lobe has the better one of its moment start and its
// first-order start (fit/starting_points.h) as few samples see them, of the status `fitted`; or, of
// the status `analytic`, the latter where nothing needs to be fitted. Losses are not measured: NaN.
std::vector<FittedEntry> start_table(const Grid& grid, const std::vector<PlannedEntry>& plan,
                                     const RunContext& run);

}  // namespace ltc
