// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/platform.h"
#include "fit/fit_table.h"
#include "interpolate/between_fits.h"
#include "pipeline/first_entries.h"
#include "refine/field_fit.h"
#include "refine/refine.h"
#include "refine/refine_queries.h"
#include "table/symmetry.h"

namespace ltc {
namespace {

// Which nodes have values once those that are needed are made.
std::vector<bool> values_behind(const std::vector<bool>& needed, const RefineContext& context) {
  std::vector<bool> present = needed;
  for (std::size_t flat = 0; flat < present.size(); ++flat)
    present[flat] = present[flat] || context.has_existing(flat);
  return present;
}

// The table and what its files are made in, one after the other; or what its values are made from.
std::size_t memory_between_fits(const Config& config) {
  constexpr std::size_t of_entry = 12 * sizeof(float) + 4, of_files = 60;
  constexpr std::size_t of_program = std::size_t{30} << 20;
  return of_program + config.grid.size() * of_entry +
         std::max(config.grid.size() * of_files, between_fits_memory_bytes(config.grid));
}

// What making the table takes of memory, about: its refinement, and the rest.
struct MemoryNeeded {
  std::size_t table, refinement;
};
MemoryNeeded memory_needed(const Config& config, const std::vector<bool>& needed,
                           const RefineContext& context) {
  // The table, and its values again in every file that is made of it; fits, those of a sweep, and
  // those in the journal and in a checkpoint.
  constexpr std::size_t of_value = 5 * (12 * sizeof(float) + 4);
  if (is_interpolated(config, needed))
    return {memory_between_fits(config), 0};
  const auto fits = static_cast<std::size_t>(2 + 2 * (1 + sweep_count(config.fit)));
  MemoryNeeded memory{
      config.grid.size() * (of_value + sizeof(PlannedEntry) + fits * sizeof(FittedEntry)), 0};
  if (config.field.size > 0)
    memory.refinement = field_fit_memory_bytes(config.field, config.refine.sampling);
  if (config.refine.steps == 0 || config.field.size > 0)
    return memory;
  memory.refinement = refinement_memory_bytes(config.grid, config.storage,
                                              values_behind(needed, context), config.refine);
  return memory;
}

}  // namespace

bool is_interpolated(const Config& config, const std::vector<bool>& needed) {
  // Up to so many lobes fits take seconds.
  constexpr std::size_t most_fitted = 20'000;
  const FitSettings& fit = config.fit;
  const bool may = fit.interpolation == InterpolationMode::automatic &&
                   fit.solver == SolverKind::gauss_newton && fit.lobe == LobeKind::single &&
                   fit.horizon == HorizonMode::clipped && sweep_count(fit) == 0 &&
                   config.refine.steps == 0 && config.field.size == 0 &&
                   config.storage != Storage::inverse;
  return may && has_long_axis(config.grid) && EqualLobes(config.grid).count() > most_fitted &&
         std::ranges::find(needed, false) == needed.end();
}

Cost cost_of(const Config& config, const std::vector<bool>& needed, const RefineContext& context) {
  const MemoryNeeded memory = memory_needed(config, needed, context);
  Cost cost;
  cost.memory_bytes = memory.table + memory.refinement;
  if (config.field.size > 0) {
    cost.queries = static_cast<std::size_t>(config.field.queries);
    return cost;
  }
  const bool whole = std::find(needed.begin(), needed.end(), false) == needed.end();
  if (config.storage == Storage::folded)
    cost.queries = static_cast<std::size_t>(config.field.queries);
  cost.interpolated = is_interpolated(config, needed);
  if (cost.interpolated)
    cost.fits = estimated_fits(config.grid);
  else if (config.storage != Storage::folded || config.refine.steps == 0)
    cost.fits =
        whole && !starts_in_closed_form(config)
            ? EqualLobes(config.grid).count()
            : representative_count(plan_of_fits(config, plan_by_symmetry(config.grid, needed)));
  if (config.refine.steps > 0)
    cost.queries += refined_query_count(config.grid, values_behind(needed, context), config.refine);
  return cost;
}

// Better now than after hours, and better than to bring down the machine.
void require_memory(const Config& config, const std::vector<bool>& needed,
                    const RefineContext& context, int ranks_here) {
  const MemoryNeeded memory = memory_needed(config, needed, context);
  const std::size_t available =
      platform::available_memory_bytes() / static_cast<std::size_t>(ranks_here);
  const auto gigabytes = [](std::size_t bytes) { return static_cast<double>(bytes) / 1e9; };
  const std::string to_each =
      ranks_here > 1 ? fmt::format(" to each of {} ranks", ranks_here) : std::string();
  if (memory.table > available)
    throw InputError(
        fmt::format("a table of {} entries needs about {:.3g} GB of memory, and {:.3g} GB are "
                    "available{}; fewer nodes need less",
                    config.grid.size(), gigabytes(memory.table), gigabytes(available), to_each));
  if (memory.table + memory.refinement > available)
    throw InputError(fmt::format(
        "refining a table of {} entries needs about {:.3g} GB of memory, and {:.3g} GB are "
        "available{}; a smaller refine.queries_per_cell (here {}) or refine.directions (here {}) "
        "needs less, refine.steps = 0 needs {:.3g} GB in all",
        config.grid.size(), gigabytes(memory.table + memory.refinement), gigabytes(available),
        to_each, config.refine.queries_per_cell, config.refine.sampling.directions,
        gigabytes(memory.table)));
}

}  // namespace ltc
