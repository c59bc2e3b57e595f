// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/first_entries.h"

#include "fit/start_table.h"

namespace ltc {

bool starts_in_closed_form(const Config& config) {
  return config.refine.steps > 0 && config.refine.start == RefineStart::closed_form &&
         config.fit.solver == SolverKind::gauss_newton;
}

bool is_smoothest(const Grid& grid, std::size_t flat) {
  return grid.alpha.nodes[grid.node(flat).alpha] <= grid.alpha_min;
}

std::vector<PlannedEntry> plan_of_fits(const Config& config,
                                       const std::vector<PlannedEntry>& plan) {
  if (!starts_in_closed_form(config))
    return plan;
  std::vector<PlannedEntry> fitted(plan.size());
  for (std::size_t flat = 0; flat < plan.size(); ++flat)
    if (config.refine.keep_smoothest && is_smoothest(config.grid, flat))
      fitted[flat] = plan[flat];
  return fitted;
}

std::vector<FittedEntry> first_entries(const Config& config, const std::vector<PlannedEntry>& plan,
                                       const RunContext& run, FitJournal* journal) {
  if (!starts_in_closed_form(config))
    return fit_table(config.grid, config.fit, plan, run, nullptr, journal);
  std::vector<FittedEntry> entries = start_table(config.grid, plan, run);
  const std::vector<PlannedEntry> to_fit = plan_of_fits(config, plan);
  if (representative_count(to_fit) == 0)
    return entries;
  const std::vector<FittedEntry> fitted =
      fit_table(config.grid, config.fit, to_fit, run, nullptr, journal);
  for (std::size_t flat = 0; flat < entries.size(); ++flat)
    if (to_fit[flat].representative != PlannedEntry::none)
      entries[flat] = fitted[flat];
  return entries;
}

}  // namespace ltc
