// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/fit_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "core/spread.h"
#include "fit/fit_journal.h"
#include "fit/lobe_frame.h"
#include "table/symmetry.h"

namespace ltc {
namespace {

// Takes the results that the journal of the first rank knows; what is left to be fitted.
std::vector<std::size_t> recall_known(const FitJournal* journal, int round,
                                      const std::vector<std::size_t>& to_fit, const RunContext& run,
                                      std::vector<FittedEntry>& results) {
  std::string is_known, known;
  for (const std::size_t flat : to_fit) {
    is_known += journal && journal->recall(round, flat, results[flat]) ? 'k' : 'u';
    if (run.ranks && is_known.back() == 'k')
      append_bytes(results[flat], known);
  }
  share_from_first(run.ranks, is_known);
  share_from_first(run.ranks, known);
  std::vector<std::size_t> unknown;
  std::size_t at = 0;
  for (std::size_t i = 0; i < to_fit.size(); ++i)
    if (is_known[i] == 'u')
      unknown.push_back(to_fit[i]);
    else if (run.ranks)
      at += take_bytes(known, at, results[to_fit[i]]);
  return unknown;
}

// In an order that takes from everywhere: how costly entries are changes along the axes, and the
// pace of the first ones is to tell how long all of them take. The points of a golden-ratio
// lattice.
std::vector<std::size_t> spread_out(const std::vector<std::size_t>& entries) {
  const std::size_t count = entries.size();
  auto stride = static_cast<std::size_t>(static_cast<double>(count) * (std::numbers::phi - 1));
  while (std::gcd(std::max(stride, std::size_t{1}), count) != 1)
    ++stride;
  std::vector<std::size_t> result(count);
  for (std::size_t i = 0, at = 0; i < count; ++i, at = (at + stride) % count)
    result[i] = entries[at];
  return result;
}

// Steps of the watched entry go to its watch, those of the others nowhere.
std::vector<FitStep>* trace_of(FitWatch* watch, std::size_t flat) {
  return watch && watch->entry == flat ? &watch->fits.back().steps : nullptr;
}

// One fit of each entry of a list, whatever its request is.
class FitRounds {
 public:
  FitRounds(const Grid& grid, const FitSettings& settings, const RunContext& run, FitWatch* watch,
            FitJournal* journal)
      : grid_(grid),
        seed_(settings.seed),
        run_(run),
        watch_(watch),
        journal_(journal),
        solver_(make_solver(settings)),
        equal_(grid) {}

  FitRequest plain_request(std::size_t flat) const {
    return {grid_.lobe(flat), entry_seed(seed_, equal_.first_of(flat)), {}, {}, run_.progress};
  }

  void fit_all(std::string_view stage, int round, const std::vector<std::size_t>& to_fit,
               const std::function<FitRequest(std::size_t)>& request,
               std::vector<FittedEntry>& results) const {
    const std::vector<std::size_t> unknown =
        spread_out(recall_known(journal_, round, to_fit, run_, results));
    // A stop ends a fit early, with whatever it has.
    const auto note = [&](std::size_t i) {
      if (journal_ && !run_.stop_requested())
        journal_->note(round, unknown[i], results[unknown[i]]);
    };
    spread_for_each<FitWorkspacePointer>(
        stage, Spreading::moving, unknown.size(), run_, make_fit_workspace,
        [&](std::size_t i, FitWorkspacePointer& workspace) {
          const std::size_t flat = unknown[i];
          fit_entry(*solver_, request(flat), *workspace, trace_of(watch_, flat), results[flat]);
          note(i);
        },
        [&](std::size_t i, auto&& take) { take(bytes_of(results[unknown[i]])); }, note);
  }

 private:
  const Grid& grid_;
  const std::uint64_t seed_;
  const RunContext run_;
  FitWatch* const watch_;
  FitJournal* const journal_;
  const std::unique_ptr<Solver> solver_;
  const EqualLobes equal_;
};

std::vector<std::size_t> entries_to_fit(const std::vector<PlannedEntry>& plan) {
  std::vector<std::size_t> to_fit;
  for (std::size_t flat = 0; flat < plan.size(); ++flat)
    if (plan[flat].representative == flat)
      to_fit.push_back(flat);
  return to_fit;
}

void require_plain(const FitSettings& settings) {
  if (settings.lobe == LobeKind::folded)
    throw InputError("fit.lobe = \"folded\" for entries of a table; expected \"single\"");
}

}  // namespace

Eigen::Matrix3d rounded_to_symmetry(const Lobe& lobe, Eigen::Matrix3d matrix) {
  if (lobe.alpha_x == lobe.alpha_y && looks_upward(lobe.theta_radians))
    matrix(0, 0) = matrix(1, 1) = (matrix(0, 0) + matrix(1, 1)) / 2;
  return matrix;
}

void copy_by_symmetry(const std::vector<PlannedEntry>& plan, const RunContext& run,
                      std::vector<FittedEntry>& entries) {
  parallel_for(plan.size(), run, [&](std::size_t flat) {
    const std::size_t representative = plan[flat].representative;
    if (representative == flat || representative == PlannedEntry::none)
      return;
    const FittedEntry& source = entries[representative];
    entries[flat] = {turned(source.matrix, plan[flat].turn_radians), source.loss, 0,
                     has_values(source.status) ? Status::copied : source.status};
  });
}

FitResult fit_entry(const Solver& solver, const FitRequest& request, FitWorkspace& workspace,
                    std::vector<FitStep>* trace, FittedEntry& entry) {
  const FitResult result = solver.fit(request, workspace, trace);
  entry.steps += result.steps;
  if (request.incumbent && result.matrix == request.incumbent->matrix)
    return result;
  if (result.outcome == FitOutcome::non_finite) {
    entry.status = Status::failed;
    entry.matrix.setConstant(std::numeric_limits<double>::quiet_NaN());
    entry.loss = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  entry.status = result.outcome == FitOutcome::analytic ? Status::analytic : Status::fitted;
  entry.matrix = rounded_to_symmetry(request.lobe, result.matrix);
  entry.loss = result.loss;
  entry.fold = result.fold;
  return result;
}

std::vector<Eigen::Matrix3d> neighbour_starts(const Grid& grid, std::size_t flat,
                                              const std::vector<FittedEntry>& entries) {
  std::vector<Eigen::Matrix3d> starts;
  const LobeFrame frame(grid.lobe(flat));
  for (const std::size_t neighbour : grid.neighbours(flat)) {
    const FittedEntry& entry = entries[neighbour];
    if (has_values(entry.status))
      starts.push_back(frame.to_matrix(LobeFrame(grid.lobe(neighbour)).from_matrix(entry.matrix)));
  }
  return starts;
}

std::uint64_t entry_seed(std::uint64_t seed, std::size_t representative) {
  // SplitMix64's finaliser (Steele, Lea and Flood 2014): neighbouring entries get unrelated seeds.
  std::uint64_t z = seed * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(representative) + 1;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

std::vector<FittedEntry> fit_table(const Grid& grid, const FitSettings& settings,
                                   const std::vector<bool>& needed, const RunContext& run,
                                   FitWatch* watch, FitJournal* journal) {
  return fit_table(grid, settings, plan_by_symmetry(grid, needed, run), run, watch, journal);
}

std::vector<FittedEntry> fit_table(const Grid& grid, const FitSettings& settings,
                                   const std::vector<PlannedEntry>& plan, const RunContext& run,
                                   FitWatch* watch, FitJournal* journal) {
  require_plain(settings);
  const FitRounds rounds(grid, settings, run, watch, journal);
  std::vector<std::size_t> to_fit = entries_to_fit(plan);
  std::vector<FittedEntry> entries(grid.size());
  const auto plain_request = [&](std::size_t flat) { return rounds.plain_request(flat); };
  if (watch)
    watch->fits.assign(1, {});
  rounds.fit_all("fit", 0, to_fit, plain_request, entries);
  copy_by_symmetry(plan, run, entries);
  // Nothing that samples could tell is better than a closed form.
  std::erase_if(to_fit, [&](std::size_t flat) { return entries[flat].status == Status::analytic; });
  const bool watching = watch && entries[watch->entry].status != Status::analytic;
  for (int sweep = 1; sweep <= sweep_count(settings); ++sweep) {
    std::vector<FittedEntry> improved = entries;
    if (watching)
      watch->fits.push_back(
          {sweep, neighbour_starts(grid, watch->entry, entries).size(), {}, false});
    rounds.fit_all(
        "sweep", sweep, to_fit,
        [&](std::size_t flat) {
          FitRequest request = plain_request(flat);
          request.starts = neighbour_starts(grid, flat, entries);
          if (has_values(entries[flat].status))
            request.incumbent =
                FitResult{entries[flat].matrix, entries[flat].loss, 0, FitOutcome::converged};
          return request;
        },
        improved);
    copy_by_symmetry(plan, run, improved);
    if (watching)
      watch->fits.back().improved = improved[watch->entry].loss < entries[watch->entry].loss;
    entries = std::move(improved);
  }
  return entries;
}

std::vector<std::size_t> entries_of_shard(const std::vector<PlannedEntry>& plan,
                                          const Shard& shard) {
  const std::vector<std::size_t> all = spread_out(entries_to_fit(plan));
  std::vector<std::size_t> share;
  for (auto i = static_cast<std::size_t>(shard.number - 1); i < all.size();
       i += static_cast<std::size_t>(shard.count))
    share.push_back(all[i]);
  return share;
}

void fit_shard(const Grid& grid, const FitSettings& settings, const std::vector<PlannedEntry>& plan,
               const Shard& shard, const RunContext& run, FitJournal* journal) {
  require_plain(settings);
  const FitRounds rounds(grid, settings, run, nullptr, journal);
  std::vector<FittedEntry> entries(grid.size());
  rounds.fit_all(
      "fit", 0, entries_of_shard(plan, shard),
      [&](std::size_t flat) { return rounds.plain_request(flat); }, entries);
}

}  // namespace ltc
