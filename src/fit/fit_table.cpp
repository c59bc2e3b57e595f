// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/fit_table.h"

#include <cmath>
#include <functional>
#include <limits>

#include "core/parallel.h"
#include "fit/lobe_frame.h"
#include "table/symmetry.h"

namespace ltc {
namespace {

// Seen from above, an isotropic lobe is round; its fit is but for the noise of its samples.
Eigen::Matrix3d rounded_to_symmetry(const GgxLobe& lobe, Eigen::Matrix3d matrix) {
  if (lobe.alpha_x == lobe.alpha_y && looks_upward(lobe.theta_radians))
    matrix(0, 0) = matrix(1, 1) = (matrix(0, 0) + matrix(1, 1)) / 2;
  return matrix;
}

void fit_entry(const Solver& solver, const FitRequest& request, FitWorkspace& workspace,
               FittedEntry& entry) {
  const FitResult result = solver.fit(request, workspace, nullptr);
  entry.steps += result.steps;
  if (result.outcome == FitOutcome::non_finite) {
    entry.status = Status::failed;
    entry.matrix.setConstant(std::numeric_limits<double>::quiet_NaN());
    entry.loss = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  entry.status = result.outcome == FitOutcome::analytic ? Status::analytic : Status::fitted;
  entry.matrix = rounded_to_symmetry(request.lobe, result.matrix);
  entry.loss = result.loss;
}

void copy_by_symmetry(const std::vector<PlannedEntry>& plan, std::vector<FittedEntry>& entries) {
  for (std::size_t flat = 0; flat < plan.size(); ++flat) {
    const std::size_t representative = plan[flat].representative;
    if (representative == flat || representative == PlannedEntry::none)
      continue;
    const FittedEntry& source = entries[representative];
    entries[flat] = {turned(source.matrix, plan[flat].turn_radians), source.loss, 0,
                     has_values(source.status) ? Status::copied : source.status};
  }
}

}  // namespace

std::vector<Eigen::Matrix3d> neighbour_starts(const Grid& grid, std::size_t flat,
                                              const std::vector<FittedEntry>& entries) {
  std::vector<Eigen::Matrix3d> starts;
  const NodeIndex node = grid.node(flat);
  const LobeFrame frame(grid.lobe(node));
  const auto add = [&](const NodeIndex& neighbour) {
    const FittedEntry& entry = entries[grid.flat(neighbour)];
    if (has_values(entry.status))
      starts.push_back(frame.to_matrix(LobeFrame(grid.lobe(neighbour)).from_matrix(entry.matrix)));
  };
  const auto shape = grid.shape();
  const std::array<std::size_t NodeIndex::*, 4> axes = {&NodeIndex::alpha, &NodeIndex::lambda,
                                                        &NodeIndex::theta, &NodeIndex::phi};
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    NodeIndex neighbour = node;
    if (node.*axes[axis] > 0) {
      neighbour.*axes[axis] = node.*axes[axis] - 1;
      add(neighbour);
    }
    if (node.*axes[axis] + 1 < shape[axis]) {
      neighbour.*axes[axis] = node.*axes[axis] + 1;
      add(neighbour);
    }
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

std::vector<FittedEntry> fit_table(const Grid& grid, const FitSettings& settings, int threads,
                                   Progress* progress) {
  return fit_table(grid, settings, std::vector<bool>(grid.size(), true), threads, progress);
}

std::vector<FittedEntry> fit_table(const Grid& grid, const FitSettings& settings,
                                   const std::vector<bool>& needed, int threads,
                                   Progress* progress) {
  const std::unique_ptr<Solver> solver = make_solver(settings);
  const std::vector<PlannedEntry> whole_plan = plan_by_symmetry(grid);
  const std::vector<PlannedEntry> plan = plan_by_symmetry(grid, needed);
  std::vector<std::size_t> to_fit;
  for (std::size_t flat = 0; flat < plan.size(); ++flat)
    if (plan[flat].representative == flat)
      to_fit.push_back(flat);

  std::vector<FittedEntry> entries(grid.size());
  const auto fit_all = [&](std::string_view stage,
                           const std::function<FitRequest(std::size_t)>& request,
                           std::vector<FittedEntry>& results) {
    parallel_for_each<FitWorkspacePointer>(
        stage, to_fit.size(), threads, progress, make_fit_workspace,
        [&](std::size_t i, FitWorkspacePointer& workspace) {
          fit_entry(*solver, request(to_fit[i]), *workspace, results[to_fit[i]]);
        });
    copy_by_symmetry(plan, results);
  };
  const auto plain_request = [&](std::size_t flat) {
    return FitRequest{grid.lobe(grid.node(flat)),
                      entry_seed(settings.seed, whole_plan[flat].representative),
                      {},
                      {},
                      progress};
  };
  fit_all("fit", plain_request, entries);
  const int sweeps =
      settings.solver == SolverKind::gauss_newton ? settings.gauss_newton.neighbour_sweeps : 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    std::vector<FittedEntry> improved = entries;
    fit_all(
        "sweep",
        [&](std::size_t flat) {
          FitRequest request = plain_request(flat);
          request.starts = neighbour_starts(grid, flat, entries);
          if (has_values(entries[flat].status))
            request.incumbent =
                FitResult{entries[flat].matrix, entries[flat].loss, 0, FitOutcome::converged};
          return request;
        },
        improved);
    entries = std::move(improved);
  }
  return entries;
}

}  // namespace ltc
