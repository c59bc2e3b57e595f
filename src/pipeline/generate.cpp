// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/generate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

#include "align/align.h"
#include "brdf/albedo.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/platform.h"
#include "core/spread.h"
#include "core/version.h"
#include "fit/fit_table.h"
#include "fit/solver.h"
#include "interpolate/between_fits.h"
#include "pipeline/first_entries.h"
#include "pipeline/post_process.h"
#include "pipeline/require_model.h"
#include "postprocess/normalise.h"
#include "refine/refine_queries.h"
#include "table/field_table.h"
#include "table/query_range.h"
#include "table/symmetry.h"

namespace ltc {
namespace {

// Numbers of the field that a folded table starts from.
constexpr int folded_start_size = 512;

// The values of one entry, from its aligned matrix.
void post_process_entry(const Grid& grid, std::size_t flat, const FittedEntry& entry, Table& table,
                        double& zeroed) {
  table.status[flat] = entry.status;
  table.iterations[flat] = static_cast<std::uint16_t>(
      std::min(entry.steps, static_cast<int>(std::numeric_limits<std::uint16_t>::max())));
  if (!has_values(entry.status))
    return;
  const PostProcessed finished = post_process(grid.lobe(flat), table.storage, entry.matrix);
  zeroed = finished.zeroed;
  table.set_stored(flat, finished.stored);
  table.sw_loss[flat] = static_cast<float>(entry.loss);
}

void align_all(std::vector<FittedEntry>& entries, const RunContext& run) {
  parallel_for_each("align", entries.size(), run, [&](std::size_t i) {
    if (has_values(entries[i].status))
      entries[i].matrix = align(entries[i].matrix);
  });
}

// The first of the largest, in whatever order they come.
void note_zeroed(double zeroed, std::size_t flat, GenerateReport& report) {
  if (zeroed > report.largest_zeroed ||
      (zeroed == report.largest_zeroed && zeroed > 0 && flat < report.largest_zeroed_entry)) {
    report.largest_zeroed = zeroed;
    report.largest_zeroed_entry = flat;
  }
}

// From aligned matrices to the table. At theta = 0 all phi share one lobe; their matrices are made
// the same bits here.
void post_process_all(const Grid& grid, const std::vector<FittedEntry>& entries, Table& table,
                      const RunContext& run, GenerateReport& report) {
  for (std::size_t flat = 0; flat < entries.size(); ++flat) {
    run.throw_if_stopped();
    double zeroed = 0;
    post_process_entry(grid, flat, entries[flat], table, zeroed);
    note_zeroed(zeroed, flat, report);
  }
}

// Big tables: fits at some nodes, and what lies between them.
void fill_between_fits(const Config& config, const RunContext& run, FitJournal* journal,
                       Table& table, GenerateReport& report) {
  std::mutex mutex;
  const BetweenFitsReport made = fill_between_fits(
      config.grid, config.fit, {}, run, journal, [&](std::size_t flat, const FittedEntry& entry) {
        double zeroed = 0;
        post_process_entry(config.grid, flat, entry, table, zeroed);
        if (zeroed == 0)
          return;
        const std::lock_guard lock(mutex);
        note_zeroed(zeroed, flat, report);
      });
  report.fits = made.fits;
}

bool has_values_in(const Table* table, std::size_t flat) {
  return table && has_values(table->status[flat]);
}

// Which nodes have values once those that are needed are made.
std::vector<bool> values_behind(const std::vector<bool>& needed, const RefineContext& context) {
  std::vector<bool> present = needed;
  for (std::size_t flat = 0; flat < present.size(); ++flat)
    present[flat] = present[flat] || has_values_in(context.existing, flat);
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

// What is refined on: what is asked for, as far as the table serves it.
std::vector<QueryRange> ranges_served(const Config& config, const std::vector<QueryRange>& asked) {
  if (asked.empty())
    return {query_range_of(config.grid, config.refine.range)};
  std::vector<QueryRange> served;
  for (const QueryRange& range : asked)
    served.push_back(clamped_range(config.grid, range));
  return served;
}

// What of a node is refined.
void get_node(const Table& table, std::size_t flat, Eigen::Matrix3d& node) {
  node = table.stored_at(flat);
}
void get_node(const Table& table, std::size_t flat, FoldedNode& node) {
  node << flattened(table.stored_at(flat)), table.fold[2 * flat], table.fold[2 * flat + 1];
}
void set_node(const Eigen::Matrix3d& node, std::size_t flat, Table& table) {
  table.set_stored(flat, normalise(table.storage, node));
}
void set_node(const FoldedNode& node, std::size_t flat, Table& table) {
  set_node(matrix_of(node), flat, table);
  table.fold[2 * flat] = static_cast<float>(node[9]);
  table.fold[2 * flat + 1] = static_cast<float>(node[10]);
}

// Their losses, of those that are `chosen`, after their matrices were made otherwise than by fits
// of their own.
template <typename Node>
void measure_losses(const std::vector<bool>& chosen, const RunContext& run, Table& table) {
  std::vector<Node> stored(table.grid.size());
  for (std::size_t flat = 0; flat < stored.size(); ++flat)
    get_node(table, flat, stored[flat]);
  const std::vector<double> losses =
      node_losses({table.grid, table.storage, chosen, table.creases}, stored, run);
  for (std::size_t flat = 0; flat < losses.size(); ++flat)
    if (chosen[flat])
      table.sw_loss[flat] = static_cast<float>(losses[flat]);
}

// Moves the nodes' matrices for the sake of what lies between them, and states their losses anew.
template <typename Node>
RefineReport refine_nodes(const Config& config, const RefineContext& context,
                          const std::vector<QueryRange>& ranges, const RunContext& run,
                          Table& table) {
  const std::size_t count = table.grid.size();
  std::vector<Node> stored(count);
  std::vector<bool> present(count), movable(count);
  for (std::size_t flat = 0; flat < count; ++flat) {
    const bool made = has_values(table.status[flat]);
    const bool kept = !made && has_values_in(context.existing, flat);
    get_node(kept ? *context.existing : table, flat, stored[flat]);
    present[flat] = made || kept;
    movable[flat] = made && !(config.refine.keep_smoothest && is_smoothest(table.grid, flat));
  }
  const RefineReport report = refine({table.grid, table.storage, present, table.creases}, movable,
                                     ranges, config.refine, run, stored);
  if (!report.kept)
    return report;
  for (std::size_t flat = 0; flat < count; ++flat)
    if (movable[flat])
      set_node(stored[flat], flat, table);
  measure_losses<Node>(movable, run, table);
  return report;
}
RefineReport refine_nodes(const Config& config, const RefineContext& context,
                          const std::vector<QueryRange>& ranges, const RunContext& run,
                          Table& table) {
  return is_folded(table) ? refine_nodes<FoldedNode>(config, context, ranges, run, table)
                          : refine_nodes<Eigen::Matrix3d>(config, context, ranges, run, table);
}

void measure_losses(const RunContext& run, Table& table) {
  std::vector<bool> present(table.grid.size());
  std::transform(table.status.begin(), table.status.end(), present.begin(), has_values);
  if (is_folded(table))
    measure_losses<FoldedNode>(present, run, table);
  else
    measure_losses<Eigen::Matrix3d>(present, run, table);
}

// `representative_of` a node, or PlannedEntry::none, as in a plan by symmetry.
template <typename Representative>
void integrate_albedos(const Grid& grid, const Representative& representative_of,
                       const RunContext& run, Table& table) {
  const AlbedoRule rule;
  spread_for_each<int>(
      "albedo", Spreading::moving, grid.size(), run, [] { return 0; },
      [&](std::size_t flat, int) {
        if (representative_of(flat) != flat)
          return;
        const Albedo albedo = integrate_albedo(grid.lobe(flat), rule);
        table.amplitude[flat] = static_cast<float>(albedo.amplitude);
        table.fresnel[flat] = static_cast<float>(albedo.fresnel);
      },
      [&](std::size_t flat, auto&& take) {
        take(bytes_of(table.amplitude[flat]));
        take(bytes_of(table.fresnel[flat]));
      });
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const std::size_t representative = representative_of(flat);
    if (representative == PlannedEntry::none)
      continue;
    table.amplitude[flat] = table.amplitude[representative];
    table.fresnel[flat] = table.fresnel[representative];
  }
}

// A field has no axes to serve: what is asked for stands.
std::vector<QueryRange> ranges_of_field(const Config& config,
                                        const std::vector<QueryRange>& asked) {
  return asked.empty() ? std::vector{config.refine.range} : asked;
}

// What no scene asks for has no values.
void skip_others(const std::vector<bool>& needed, Table& table) {
  const Table none = Table::empty(table.grid, table.storage);
  for (std::size_t flat = 0; flat < needed.size(); ++flat) {
    if (needed[flat])
      continue;
    std::copy_n(none.stored.begin(), 9,
                table.stored.begin() + static_cast<std::ptrdiff_t>(9 * flat));
    std::copy_n(none.fold.begin(), is_folded(table) ? 2 : 0,
                table.fold.begin() + static_cast<std::ptrdiff_t>(2 * flat));
    table.amplitude[flat] = none.amplitude[flat];
    table.fresnel[flat] = none.fresnel[flat];
    table.status[flat] = none.status[flat];
  }
}

// The nodes of a folded table before they are refined: the values of a small field. Its folds are
// of one branch everywhere, and as symmetric and continuous as those of a table should be.
Table nodes_of_small_field(const Config& config, const std::vector<QueryRange>& asked,
                           const RunContext& run) {
  FieldSettings settings = config.field;
  settings.size = folded_start_size;
  settings.half = false;
  const Field field = fit_field(config.grid.alpha_min, *config.grid.model,
                                ranges_of_field(config, asked), settings, config.refine, run);
  Table table = table_of_field(field, config.grid, Storage::folded, run);
  table.field.reset();
  return table;
}

// The node itself, or at theta = 0, where every phi has the same lobe, the first one with values.
std::size_t first_of_same(const Table& table, std::size_t flat) {
  NodeIndex node = table.grid.node(flat);
  if (!looks_upward(table.grid.theta.nodes[node.theta]))
    return flat;
  for (node.phi = 0; !has_values(table.status[table.grid.flat(node)]);)
    ++node.phi;
  return table.grid.flat(node);
}

// Each node that is chosen fitted by itself, from the values that it has; but of the smoothest,
// which a field is not made for.
void fit_folded_nodes(const FitSettings& settings, const std::vector<bool>& chosen,
                      const RunContext& run, Table& table) {
  const std::unique_ptr<Solver> solver = make_solver(settings);
  const auto fit = [&](std::size_t flat, FitWorkspace& workspace) {
    FitRequest request;
    request.lobe = table.grid.lobe(flat);
    request.seed = entry_seed(settings.seed, flat);
    if (!is_smoothest(table.grid, flat)) {
      request.incumbent.emplace();
      request.incumbent->matrix = table.matrix_at(flat);
      request.incumbent->fold = table.fold_at(flat);
    }
    request.progress = run.progress;
    return solver->fit(request, workspace, nullptr);
  };
  spread_for_each<FitWorkspacePointer>(
      "fit", Spreading::moving, table.grid.size(), run, make_fit_workspace,
      [&](std::size_t flat, FitWorkspacePointer& workspace) {
        if (!chosen[flat] || first_of_same(table, flat) != flat)
          return;
        const FitResult result = fit(flat, *workspace);
        const Lobe lobe = table.grid.lobe(flat);
        FoldedNode node;
        node << flattened(stored_from_matrix(table.storage, result.matrix, lobe)),
            kappa_of(result.fold, lobe), result.fold.g;
        set_node(node, flat, table);
        table.sw_loss[flat] = static_cast<float>(result.loss);
        table.iterations[flat] = static_cast<std::uint16_t>(result.steps);
      },
      [&](std::size_t flat, auto&& take) {
        for (std::size_t i = 0; i < 9; ++i)
          take(bytes_of(table.stored[9 * flat + i]));
        for (std::size_t i = 0; i < 2; ++i)
          take(bytes_of(table.fold[2 * flat + i]));
        take(bytes_of(table.sw_loss[flat]));
        take(bytes_of(table.iterations[flat]));
      });
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat)
    if (chosen[flat] && first_of_same(table, flat) != flat) {
      FoldedNode node;
      get_node(table, first_of_same(table, flat), node);
      set_node(node, flat, table);
      table.status[flat] = Status::copied;
    }
}

// The entries of a plain table before they are refined.
template <typename FinishStage>
void fill_plain(const Config& config, const std::vector<PlannedEntry>& plan, const RunContext& run,
                FitJournal* journal, GenerateReport& result, const FinishStage& finish_stage,
                Table& table) {
  result.fits = representative_count(plan_of_fits(config, plan));
  result.fits_of_whole_grid = result.fits == 0 ? 0 : EqualLobes(config.grid).count();
  std::vector<FittedEntry> entries = first_entries(config, plan, run, journal);
  finish_stage(starts_in_closed_form(config) ? "start" : "fit");
  align_all(entries, run);
  finish_stage("align");
  post_process_all(config.grid, entries, table, run, result);
  // Files state the losses of whole lobes.
  if (config.fit.horizon == HorizonMode::scaled)
    measure_losses(run, table);
  finish_stage("post-process");
}

void describe(const Config& config, Table& table) {
  table.seed = config.fit.seed;
  table.config = to_toml(config);
  table.generator = generator();
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

Table generate_table(const Config& config, const RunContext& run, GenerateReport* report) {
  return generate_table(config, std::vector<bool>(config.grid.size(), true), run, report);
}

Table generate_table(const Config& config, const std::vector<bool>& needed, const RunContext& run,
                     GenerateReport* report, FitJournal* journal, const RefineContext& context) {
  require_model(config);
  GenerateReport unread;
  GenerateReport& result = report ? *report : unread;
  auto lap = std::chrono::steady_clock::now();
  const auto finish_stage = [&](const char* name) {
    const auto now = std::chrono::steady_clock::now();
    result.stage_seconds.emplace_back(name, std::chrono::duration<double>(now - lap).count());
    lap = now;
  };

  if (config.field.size > 0) {
    result.field.emplace();
    const Field field =
        fit_field(config.grid.alpha_min, *config.grid.model, ranges_of_field(config, context.asked),
                  config.field, config.refine, run, &*result.field);
    finish_stage("field");
    Table table = table_of_field(field, config.grid, config.storage, run);
    skip_others(needed, table);
    measure_losses(run, table);
    describe(config, table);
    finish_stage("nodes");
    return table;
  }

  if (is_interpolated(config, needed)) {
    Table table = Table::empty(config.grid, config.storage);
    result.fits_of_whole_grid = EqualLobes(config.grid).count();
    fill_between_fits(config, run, journal, table, result);
    finish_stage("fit");
    describe(config, table);
    table.refined = false;
    const EqualLobes equal(config.grid);
    integrate_albedos(
        config.grid, [&](std::size_t flat) { return equal.first_of(flat); }, run, table);
    finish_stage("albedo");
    return table;
  }

  const std::vector<PlannedEntry> plan = plan_by_symmetry(config.grid, needed, run);
  const std::size_t lobes = representative_count(plan);
  Table table = Table::empty(config.grid, config.storage);
  if (is_folded(table)) {
    table = nodes_of_small_field(config, context.asked, run);
    skip_others(needed, table);
    finish_stage("field");
    std::vector<bool> chosen(table.grid.size());
    for (std::size_t flat = 0; flat < chosen.size(); ++flat)
      chosen[flat] = has_values(table.status[flat]) &&
                     (config.refine.steps == 0 ||
                      (config.refine.keep_smoothest && is_smoothest(table.grid, flat)));
    fit_folded_nodes(config.fit, chosen, run, table);
    result.fits = static_cast<std::size_t>(std::ranges::count(chosen, true));
    finish_stage("fit");
    measure_losses(run, table);
  } else {
    fill_plain(config, plan, run, journal, result, finish_stage, table);
  }
  describe(config, table);
  table.refined = false;
  if (config.refine.steps > 0 && lobes > 0) {
    const std::vector<QueryRange> ranges = ranges_served(config, context.asked);
    if (context.asked.empty() && ranges.front() != config.refine.range)
      result.range_served = ranges.front();
    result.refine = refine_nodes(config, context, ranges, run, table);
    if (!is_folded(table) && starts_in_closed_form(config) && !result.refine->converged) {
      Config by_fits = config;
      by_fits.refine.start = RefineStart::fits;
      fill_plain(by_fits, plan, run, journal, result, finish_stage, table);
      result.refine = refine_nodes(config, context, ranges, run, table);
    }
    table.refined = result.refine->kept;
    finish_stage("refine");
  }
  integrate_albedos(
      config.grid, [&](std::size_t flat) { return plan[flat].representative; }, run, table);
  finish_stage("albedo");
  return table;
}

}  // namespace ltc
