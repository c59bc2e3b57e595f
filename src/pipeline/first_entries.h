// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The matrices that a table begins with: each node's fit, or what refinement begins with instead.
#pragma once

#include <vector>

#include "config/config.h"
#include "core/run_context.h"
#include "fit/fit_journal.h"
#include "fit/fit_table.h"
#include "fit/symmetry_plan.h"

namespace ltc {

// Whether refinement begins with matrices in closed form (fit/start_table.h). Then only nodes that
// it leaves as they are (refine.keep_smoothest) are fitted.
bool starts_in_closed_form(const Config& config);

// The entries of the plan that are fitted.
std::vector<PlannedEntry> plan_of_fits(const Config& config, const std::vector<PlannedEntry>& plan);

// As fit_table, by these two.
std::vector<FittedEntry> first_entries(const Config& config, const std::vector<PlannedEntry>& plan,
                                       const RunContext& run, FitJournal* journal);

// The nodes that refine.keep_smoothest is about.
bool is_smoothest(const Grid& grid, std::size_t flat);

}  // namespace ltc
