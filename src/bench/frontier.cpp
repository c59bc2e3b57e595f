// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "bench/frontier.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "core/platform.h"
#include "fit/fit_table.h"
#include "judge/held_out.h"

namespace ltc {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

// The process's, which is the fit's: nothing else of it works meanwhile. What other processes take
// from the core does not count.
class Stopwatch {
 public:
  double seconds() const { return platform::processor_seconds() - begin_; }

 private:
  double begin_ = platform::processor_seconds();
};

// What one setting makes of an entry.
struct Fit {
  FitResult result;
  double seconds = 0;
};

// Fits entries with one setting as fit_table does, but one at a time and with a clock. A sweep
// needs the neighbours' first fits, which are made when first asked for and never timed.
class SettingRunner {
 public:
  SettingRunner(const BenchSetting& setting, const Grid& grid,
                const std::vector<PlannedEntry>& plan, FitWorkspace& workspace,
                const Progress* progress)
      : setting_(setting),
        grid_(grid),
        plan_(plan),
        workspace_(workspace),
        progress_(progress),
        solver_(make_solver(setting.fit)),
        entries_(grid.size()) {}

  Fit fit(std::size_t flat) {
    Fit fit = timed(request_for(flat));
    keep(flat, fit.result);
    if (!sweeps() || fit.result.outcome == FitOutcome::non_finite)
      return fit;
    FitRequest request = request_for(flat);
    for (const std::size_t neighbour : grid_.neighbours(flat))
      solve(neighbour);
    request.incumbent = fit.result;
    request.incumbent->outcome = FitOutcome::converged;
    const Stopwatch stopwatch;
    request.starts = neighbour_starts(grid_, flat, entries_);
    FitResult swept = solver_->fit(request, workspace_, nullptr);
    fit.seconds += stopwatch.seconds();
    swept.steps += fit.result.steps;
    fit.result = swept;
    return fit;
  }

  // The time of the whole descent from that of its first steps.
  Fit extrapolated(std::size_t flat) {
    const double one = seconds_of_steps(flat, 1);
    const double few = seconds_of_steps(flat, setting_.timed_steps + 1);
    Fit fit;
    fit.seconds =
        one + std::max(few - one, 0.0) / setting_.timed_steps * (setting_.fit.sgd.steps - 1);
    fit.result.steps = setting_.fit.sgd.steps;
    return fit;
  }

 private:
  bool sweeps() const {
    return setting_.fit.solver == SolverKind::gauss_newton &&
           setting_.fit.gauss_newton.neighbour_sweeps > 0;
  }
  FitRequest request_for(std::size_t flat) const {
    FitRequest request;
    request.lobe = grid_.lobe(flat);
    request.seed = entry_seed(setting_.fit.seed, plan_[flat].representative);
    request.progress = progress_;
    return request;
  }
  Fit timed(const FitRequest& request) {
    const Stopwatch stopwatch;
    FitResult result = solver_->fit(request, workspace_, nullptr);
    return {result, stopwatch.seconds()};
  }
  double seconds_of_steps(std::size_t flat, int steps) {
    FitSettings settings = setting_.fit;
    settings.sgd.steps = steps;
    settings.sgd.averaged_steps = 1;
    const std::unique_ptr<Solver> solver = make_solver(settings);
    const Stopwatch stopwatch;
    solver->fit(request_for(flat), workspace_, nullptr);
    return stopwatch.seconds();
  }
  void keep(std::size_t flat, const FitResult& result) {
    const bool failed = result.outcome == FitOutcome::non_finite;
    entries_[flat] = {result.matrix, result.loss, result.steps,
                      failed ? Status::failed : Status::fitted};
  }
  // A neighbour's first fit, from the lobe that it shares.
  void solve(std::size_t flat) {
    if (entries_[flat].status != Status::skipped)
      return;
    const std::size_t source = plan_[flat].representative;
    if (entries_[source].status == Status::skipped)
      keep(source, solver_->fit(request_for(source), workspace_, nullptr));
    entries_[flat] = entries_[source];
    entries_[flat].matrix = turned(entries_[source].matrix, plan_[flat].turn_radians);
  }

  const BenchSetting& setting_;
  const Grid& grid_;
  const std::vector<PlannedEntry>& plan_;
  FitWorkspace& workspace_;
  const Progress* progress_;
  std::unique_ptr<Solver> solver_;
  std::vector<FittedEntry> entries_;  // the first fits
};

ErrorSource error_source(const FrontierTask& task, const BenchSetting& setting) {
  if (setting.timed_steps == 0)
    return ErrorSource::own_fits;
  if (task.whole_fits > 0)
    return ErrorSource::whole_fits;
  return task.published ? ErrorSource::published_table : ErrorSource::none;
}

// Whether an entry, by its place in the task, is one of those fitted in whole.
std::vector<bool> fitted_in_whole(const FrontierTask& task) {
  std::vector<std::size_t> places(task.entries.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::vector<bool> chosen(places.size());
  for (const std::size_t place : strided(places, task.whole_fits))
    chosen[place] = true;
  return chosen;
}

EntryMeasurement measured(const Fit& fit, HeldOutJudge& judge) {
  return {fit.seconds, judge.loss(fit.result.matrix), fit.result.steps, true};
}

EntryMeasurement measure(const FrontierTask& task, const BenchSetting& setting, std::size_t flat,
                         bool whole, SettingRunner& runner, HeldOutJudge& judge) {
  const ErrorSource source = error_source(task, setting);
  if (source == ErrorSource::own_fits)
    return measured(runner.fit(flat), judge);
  const Fit timed = runner.extrapolated(flat);
  EntryMeasurement measurement{timed.seconds, no_value, timed.result.steps, false};
  if (source == ErrorSource::published_table) {
    measurement.loss = judge.loss(task.published->matrix_at(flat));
    measurement.judged = true;
  } else if (source == ErrorSource::whole_fits && whole) {
    measurement = measured(runner.fit(flat), judge);
  }
  return measurement;
}

double least_loss(const FrontierRun& run, std::size_t place) {
  double least = no_value;
  for (const std::vector<EntryMeasurement>& of_setting : run.measurements)
    least = std::fmin(least, of_setting[place].loss);  // takes the number of a number and a NaN
  return least;
}

// The worst entry is one of the grid, not of the task's list.
Statistics ratios_at(const FrontierTask& task, const std::vector<EntryComparison>& comparisons,
                     const std::vector<bool>& include = {}) {
  Statistics summary = ratio_statistics(comparisons, include);
  if (summary.count > 0)
    summary.largest_index = task.entries[summary.largest_index];
  return summary;
}

}  // namespace

std::vector<std::size_t> fitted_entries(const Grid& grid) {
  std::vector<std::size_t> entries;
  const std::vector<PlannedEntry> plan = plan_by_symmetry(grid);
  for (std::size_t flat = 0; flat < plan.size(); ++flat)
    if (plan[flat].representative == flat)
      entries.push_back(flat);
  return entries;
}

std::vector<std::size_t> strided(const std::vector<std::size_t>& entries, std::size_t count) {
  if (count >= entries.size())
    return entries;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(entries[(2 * i + 1) * entries.size() / (2 * count)]);
  return chosen;
}

FrontierRun measure_frontier(const FrontierTask& task, const RunContext& context) {
  for (const Table* table : {task.published, task.reference})
    if (table)
      require_same_grid(task.grid, table->grid);
  const std::vector<PlannedEntry> plan = plan_by_symmetry(task.grid);
  const std::vector<bool> whole = fitted_in_whole(task);
  const FitWorkspacePointer workspace = make_fit_workspace();
  HeldOutJudge judge(task.judge.samples, task.judge.directions, task.judge.seed);
  std::vector<SettingRunner> runners;
  for (const BenchSetting& setting : task.settings)
    runners.emplace_back(setting, task.grid, plan, *workspace, context.progress);

  FrontierRun run;
  run.measurements.resize(task.settings.size());
  const Stage stage(context, "bench", task.entries.size() * task.settings.size());
  for (std::size_t place = 0; place < task.entries.size(); ++place) {
    const std::size_t flat = task.entries[place];
    judge.set_lobe(task.grid.lobe(flat));
    for (std::size_t i = 0; i < runners.size(); ++i) {
      run.measurements[i].push_back(
          measure(task, task.settings[i], flat, whole[place], runners[i], judge));
      context.advance();
      context.throw_if_stopped();
    }
    run.reference_loss.push_back(task.reference ? judge.loss(task.reference->matrix_at(flat))
                                                : least_loss(run, place));
  }
  return run;
}

std::vector<SettingSummary> summarize(const FrontierTask& task, const FrontierRun& run) {
  const auto fitted = static_cast<double>(fitted_entries(task.grid).size());
  std::vector<SettingSummary> summaries;
  for (std::size_t i = 0; i < task.settings.size(); ++i) {
    SettingSummary summary;
    summary.extrapolated = task.settings[i].timed_steps > 0;
    summary.error_source = error_source(task, task.settings[i]);
    std::vector<double> seconds;
    std::vector<EntryComparison> comparisons;
    std::vector<bool> rough;
    for (std::size_t place = 0; place < task.entries.size(); ++place) {
      const EntryMeasurement& measurement = run.measurements[i][place];
      seconds.push_back(measurement.seconds);
      comparisons.push_back({measurement.loss, run.reference_loss[place], 0});
      const std::size_t flat = task.entries[place];
      rough.push_back(task.grid.lobe(flat).alpha_x > task.grid.alpha_min);
      summary.judged += measurement.judged;
      summary.failures += measurement.judged && !std::isfinite(measurement.loss);
    }
    summary.seconds = statistics_of(seconds);
    summary.table_seconds = summary.seconds.mean * fitted;
    summary.ratios = ratios_at(task, comparisons);
    summary.rough_ratios = ratios_at(task, comparisons, rough);
    summaries.push_back(summary);
  }
  return summaries;
}

}  // namespace ltc
