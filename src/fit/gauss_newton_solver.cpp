// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/gauss_newton_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "fit/starting_points.h"
#include "fit/workspace.h"

namespace ltc {
namespace {

// Blocks of neighbouring quantiles a direction: about 16 samples each, which is where finer blocks
// stop paying and coarser ones begin to blur the tails.
std::size_t bins_for(int samples) {
  return static_cast<std::size_t>(std::clamp(samples / 16, 32, 256));
}

}  // namespace

GaussNewtonSolver::Phase GaussNewtonSolver::make_phase(int samples, int directions, int steps,
                                                       double shift) {
  Phase phase;
  phase.cosines = make_cosine_set(static_cast<std::size_t>(samples), shift);
  for (const Eigen::Vector3d& direction :
       fibonacci_directions(static_cast<std::size_t>(directions)))
    phase.directions.push_back(direction.cast<float>());
  phase.bins = bins_for(samples);
  phase.options.steps = steps;
  return phase;
}

GaussNewtonSolver::GaussNewtonSolver(const GaussNewtonSettings& settings, TargetKind target)
    : settings_(settings),
      target_kind_(target),
      lattice_(make_target_lattice(static_cast<std::size_t>(settings.target_samples), 0.3)),
      coarse_(make_phase(settings.coarse_samples, settings.coarse_directions, settings.coarse_steps,
                         0.1)),
      fine_(make_phase(settings.samples, settings.directions, settings.steps, 0.0)) {
  coarse_.options.tolerance = settings.coarse_tolerance;
  fine_.options.tolerance = settings.tolerance;
  fine_.options.damping = 1e-3;  // it starts next to a minimum
}

void GaussNewtonSolver::prepare_target(const LobeFrame& frame, std::uint64_t seed,
                                       FitWorkspace& workspace) const {
  if (target_kind_ == TargetKind::weighted)
    sample_weighted_target(frame, lattice_, workspace.target);
  else
    sample_rejection_target(frame, static_cast<std::size_t>(settings_.target_samples), seed,
                            workspace.target);
  workspace.coarse_quantiles.build(workspace.target, coarse_.directions, coarse_.bins,
                                   workspace.model.xi, workspace.model.bins);
  workspace.fine_quantiles.build(workspace.target, fine_.directions, fine_.bins, workspace.model.xi,
                                 workspace.model.bins);
}

std::vector<Eigen::Matrix3d> GaussNewtonSolver::own_starts(const LobeFrame& frame,
                                                           std::uint64_t seed,
                                                           const FitWorkspace& workspace) const {
  std::vector<Eigen::Matrix3d> starts = {moment_start(frame, workspace.target),
                                         first_order_start(frame), identity_start(frame)};
  for (int i = 3; i < settings_.starts; ++i)
    starts.push_back(random_start(frame, workspace.target, seed + static_cast<std::uint64_t>(i)));
  starts.resize(static_cast<std::size_t>(settings_.starts));
  return starts;
}

FitResult GaussNewtonSolver::fit(const FitRequest& request, FitWorkspace& workspace,
                                 std::vector<FitStep>* trace) const {
  const LobeFrame frame(request.lobe);
  const FreeEntries free = free_entries(request.lobe);
  prepare_target(frame, request.seed, workspace);

  std::vector<Eigen::Matrix3d> starts;
  for (const Eigen::Matrix3d& matrix : request.starts)
    starts.push_back(admissible(frame.from_matrix(matrix), free));
  if (starts.empty())
    starts = own_starts(frame, request.seed, workspace);

  FitResult result;
  DescentOptions options = coarse_.options;
  Descent best;
  best.loss = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (!(starts[i].allFinite() && starts[i].determinant() > 0))
      continue;
    options.phase = static_cast<int>(i);
    const Descent descent = minimise(frame, starts[i], free, coarse_.cosines,
                                     workspace.coarse_quantiles, options, workspace.model, trace);
    result.steps += descent.steps;
    if (descent.loss < best.loss)
      best = descent;
  }
  if (!(best.loss < std::numeric_limits<double>::infinity())) {
    result.matrix.setConstant(std::numeric_limits<double>::quiet_NaN());
    result.loss = std::numeric_limits<double>::quiet_NaN();
    result.outcome = FitOutcome::non_finite;
    return result;
  }
  options = fine_.options;
  options.phase = static_cast<int>(starts.size());
  const Descent descent = minimise(frame, best.frame_matrix, free, fine_.cosines,
                                   workspace.fine_quantiles, options, workspace.model, trace);
  result.steps += descent.steps;
  result.matrix = frame.to_matrix(descent.frame_matrix);
  result.loss = descent.loss;
  result.outcome = descent.converged ? FitOutcome::converged : FitOutcome::step_limit;
  return result;
}

}  // namespace ltc
