// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/generate.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <mutex>

#include "align/align.h"
#include "brdf/albedo.h"
#include "core/parallel.h"
#include "core/spread.h"
#include "core/version.h"
#include "fit/fit_table.h"
#include "interpolate/between_fits.h"
#include "pipeline/first_entries.h"
#include "pipeline/folded_start.h"
#include "pipeline/post_process.h"
#include "pipeline/refine_nodes.h"
#include "pipeline/require_model.h"
#include "table/field_table.h"
#include "table/query_range.h"
#include "table/symmetry.h"

namespace ltc {
namespace {

// What is reported of a run, with the time of its stages.
struct Stages {
  explicit Stages(GenerateReport& made) : report(made) {}

  void finish(const char* name) {
    const auto now = std::chrono::steady_clock::now();
    report.stage_seconds.emplace_back(name, std::chrono::duration<double>(now - lap).count());
    lap = now;
  }

  GenerateReport& report;
  std::chrono::steady_clock::time_point lap = std::chrono::steady_clock::now();
};

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

// What is refined on: what is asked for, as far as the table serves it.
std::vector<QueryRange> ranges_served(const Config& config, const std::vector<QueryRange>& asked) {
  if (asked.empty())
    return {query_range_of(config.grid, config.refine.range)};
  std::vector<QueryRange> served;
  for (const QueryRange& range : asked)
    served.push_back(clamped_range(config.grid, range));
  return served;
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

// The entries of a plain table before they are refined.
void fill_plain(const Config& config, const std::vector<PlannedEntry>& plan, const RunContext& run,
                FitJournal* journal, Stages& stages, Table& table) {
  GenerateReport& report = stages.report;
  report.fits = representative_count(plan_of_fits(config, plan));
  report.fits_of_whole_grid = report.fits == 0 ? 0 : EqualLobes(config.grid).count();
  std::vector<FittedEntry> entries = first_entries(config, plan, run, journal);
  stages.finish(starts_in_closed_form(config) ? "start" : "fit");
  align_all(entries, run);
  stages.finish("align");
  post_process_all(config.grid, entries, table, run, report);
  // Files state the losses of whole lobes.
  if (config.fit.horizon == HorizonMode::scaled)
    measure_losses(run, table);
  stages.finish("post-process");
}

// The same of a folded one.
void fill_folded(const Config& config, const std::vector<bool>& needed, const RunContext& run,
                 const RefineContext& context, Stages& stages, Table& table) {
  table = nodes_of_small_field(config, ranges_of_field(config, context.asked), run);
  skip_others(needed, table);
  stages.finish("field");
  std::vector<bool> chosen(table.grid.size());
  for (std::size_t flat = 0; flat < chosen.size(); ++flat)
    chosen[flat] = has_values(table.status[flat]) &&
                   (config.refine.steps == 0 ||
                    (config.refine.keep_smoothest && is_smoothest(table.grid, flat)));
  fit_folded_nodes(config.fit, chosen, run, table);
  stages.report.fits = static_cast<std::size_t>(std::ranges::count(chosen, true));
  stages.finish("fit");
  measure_losses(run, table);
}

void describe(const Config& config, Table& table) {
  table.seed = config.fit.seed;
  table.config = to_toml(config);
  table.generator = generator();
}

Table generate_from_field(const Config& config, const std::vector<bool>& needed,
                          const RunContext& run, const RefineContext& context, Stages& stages) {
  stages.report.field.emplace();
  const Field field =
      fit_field(config.grid.alpha_min, *config.grid.model, ranges_of_field(config, context.asked),
                config.field, config.refine, run, &*stages.report.field);
  stages.finish("field");
  Table table = table_of_field(field, config.grid, config.storage, run);
  skip_others(needed, table);
  measure_losses(run, table);
  describe(config, table);
  stages.finish("nodes");
  return table;
}

Table generate_between_fits(const Config& config, const RunContext& run, FitJournal* journal,
                            Stages& stages) {
  const EqualLobes equal(config.grid);
  Table table = Table::empty(config.grid, config.storage);
  stages.report.fits_of_whole_grid = equal.count();
  fill_between_fits(config, run, journal, table, stages.report);
  stages.finish("fit");
  describe(config, table);
  table.refined = false;
  integrate_albedos(
      config.grid, [&](std::size_t flat) { return equal.first_of(flat); }, run, table);
  stages.finish("albedo");
  return table;
}

// Refined from where they are; by fits, where closed forms were no start to converge from.
void refine_filled(const Config& config, const std::vector<PlannedEntry>& plan,
                   const RunContext& run, FitJournal* journal, const RefineContext& context,
                   Stages& stages, Table& table) {
  GenerateReport& report = stages.report;
  const std::vector<QueryRange> ranges = ranges_served(config, context.asked);
  if (context.asked.empty() && ranges.front() != config.refine.range)
    report.range_served = ranges.front();
  report.refine = refine_nodes(config, context, ranges, run, table);
  if (!is_folded(table) && starts_in_closed_form(config) && !report.refine->converged) {
    Config by_fits = config;
    by_fits.refine.start = RefineStart::fits;
    fill_plain(by_fits, plan, run, journal, stages, table);
    report.refine = refine_nodes(config, context, ranges, run, table);
  }
  table.refined = report.refine->kept;
  stages.finish("refine");
}

Table generate_nodes(const Config& config, const std::vector<bool>& needed, const RunContext& run,
                     FitJournal* journal, const RefineContext& context, Stages& stages) {
  const std::vector<PlannedEntry> plan = plan_by_symmetry(config.grid, needed, run);
  Table table = Table::empty(config.grid, config.storage);
  if (is_folded(table))
    fill_folded(config, needed, run, context, stages, table);
  else
    fill_plain(config, plan, run, journal, stages, table);
  describe(config, table);
  table.refined = false;
  if (config.refine.steps > 0 && representative_count(plan) > 0)
    refine_filled(config, plan, run, journal, context, stages, table);
  integrate_albedos(
      config.grid, [&](std::size_t flat) { return plan[flat].representative; }, run, table);
  stages.finish("albedo");
  return table;
}

}  // namespace

Table generate_table(const Config& config, const RunContext& run, GenerateReport* report) {
  return generate_table(config, std::vector<bool>(config.grid.size(), true), run, report);
}

Table generate_table(const Config& config, const std::vector<bool>& needed, const RunContext& run,
                     GenerateReport* report, FitJournal* journal, const RefineContext& context) {
  require_model(config);
  GenerateReport unread;
  Stages stages(report ? *report : unread);
  if (config.field.size > 0)
    return generate_from_field(config, needed, run, context, stages);
  if (is_interpolated(config, needed))
    return generate_between_fits(config, run, journal, stages);
  return generate_nodes(config, needed, run, journal, context, stages);
}

}  // namespace ltc
