// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/gauss_newton_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
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

// A start is descended from, beside an incumbent, when its loss is below this many times the
// incumbent's: one that is worse has never overtaken it.
constexpr double promising_share = 1.5;

// A coarse gain below this share is within the noise of the coarse samples.
constexpr double worthwhile_gain = 2e-3;

// P0's error, relative to the lobe's width, is of the order of alpha/cos^2 theta. Below this it is
// less than 1e-3, which 65,536 samples do not resolve, let alone those of a fit.
constexpr double exact_first_order = 5e-4;

// Of the target's lattice; the coarse and the fine cosine samples have others. It puts heights u at
// 0.697 of their strata: the mean slope of a sharp lobe is an integral of (1 - u)^(-1/2), and there
// alone its sum over n samples has no error of the order n^(-1/2) (a zero of Hurwitz's zeta(1/2, a)
// at a = 0.3027). At 0.92 the outermost sample alone makes the lobe 1.6 % too wide for n = 4096.
constexpr double target_shift = 0.8466;

bool first_order_is_exact(const LobeFrame& frame) {
  const double cosine = frame.omega_v.z();
  return std::max(frame.lobe.alpha_x, frame.lobe.alpha_y) < exact_first_order * cosine * cosine;
}

bool usable(const Eigen::Matrix3d& start) {
  return start.allFinite() && start.determinant() > 0;
}

FitResult no_result(int steps) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {Eigen::Matrix3d::Constant(nan), nan, steps, FitOutcome::non_finite};
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
      lattice_(
          make_target_lattice(static_cast<std::size_t>(settings.target_samples), target_shift)),
      coarse_(make_phase(settings.coarse_samples, settings.coarse_directions, settings.coarse_steps,
                         0.1)),
      fine_(make_phase(settings.samples, settings.directions, settings.steps, 0.0)) {
  coarse_.options.tolerance = settings.coarse_tolerance;
  fine_.options.tolerance = settings.tolerance;
  fine_.options.damping = 1e-3;  // it starts next to a minimum
}

void GaussNewtonSolver::sample_target(const LobeFrame& frame, std::uint64_t seed,
                                      FitWorkspace& workspace) const {
  if (target_kind_ == TargetKind::weighted)
    sample_weighted_target(frame, lattice_, workspace.target);
  else
    sample_rejection_target(frame, static_cast<std::size_t>(settings_.target_samples), seed,
                            workspace.target);
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

FitResult GaussNewtonSolver::analytic_result(const LobeFrame& frame,
                                             FitWorkspace& workspace) const {
  const Eigen::Matrix3d p = admissible(frame.first_order, free_entries(frame.lobe));
  ModelValue value;
  evaluate_model(frame, p, fine_.cosines, workspace.fine_quantiles,
                 workspace.fine_quantiles.spread(), workspace.model, value);
  return {frame.to_matrix(p), value.loss, 0, FitOutcome::analytic};
}

Descent GaussNewtonSolver::best_coarse_descent(const LobeFrame& frame,
                                               const std::vector<Eigen::Matrix3d>& starts,
                                               DescentOptions options, FitWorkspace& workspace,
                                               FitResult& result,
                                               std::vector<FitStep>* trace) const {
  const FreeEntries free = free_entries(frame.lobe);
  Descent best;
  best.loss = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (!usable(starts[i]))
      continue;
    options.phase = static_cast<int>(i);
    const Descent descent = minimise(frame, starts[i], free, coarse_.cosines,
                                     workspace.coarse_quantiles, options, workspace.model, trace);
    result.steps += descent.steps;
    if (descent.loss < best.loss)
      best = descent;
  }
  return best;
}

std::vector<Eigen::Matrix3d> GaussNewtonSolver::promising(
    const LobeFrame& frame, const std::vector<Eigen::Matrix3d>& starts, double loss_to_beat,
    FitWorkspace& workspace) const {
  std::vector<Eigen::Matrix3d> kept;
  double best = promising_share * loss_to_beat;
  ModelValue value;
  for (const Eigen::Matrix3d& start : starts) {
    if (!usable(start))
      continue;
    evaluate_model(frame, start, coarse_.cosines, workspace.coarse_quantiles,
                   workspace.coarse_quantiles.spread(), workspace.model, value);
    if (value.loss < best) {
      best = value.loss;
      kept.assign(1, start);
    }
  }
  return kept;
}

FitResult GaussNewtonSolver::fit(const FitRequest& request, FitWorkspace& workspace,
                                 std::vector<FitStep>* trace) const {
  const auto begin = std::chrono::steady_clock::now();
  const auto options_of = [&](const Phase& phase) {
    DescentOptions options = phase.options;
    options.begin = begin;
    options.progress = request.progress;
    return options;
  };
  const LobeFrame frame(request.lobe);
  const FreeEntries free = free_entries(request.lobe);
  sample_target(frame, request.seed, workspace);
  workspace.coarse_quantiles.build(workspace.target, coarse_.directions, coarse_.bins,
                                   workspace.model.xi, workspace.model.bins);

  std::vector<Eigen::Matrix3d> starts;
  for (const Eigen::Matrix3d& matrix : request.starts)
    starts.push_back(admissible(frame.from_matrix(matrix), free));
  if (starts.empty())
    starts = own_starts(frame, request.seed, workspace);

  if (request.starts.empty() && first_order_is_exact(frame)) {
    workspace.fine_quantiles.build(workspace.target, fine_.directions, fine_.bins,
                                   workspace.model.xi, workspace.model.bins);
    return analytic_result(frame, workspace);
  }

  FitResult result;
  double loss_to_beat = std::numeric_limits<double>::infinity();
  if (request.incumbent) {
    result = *request.incumbent;
    result.steps = 0;
    // The incumbent settles on the coarse samples before it is compared on them.
    const Descent settled =
        minimise(frame, admissible(frame.from_matrix(result.matrix), free), free, coarse_.cosines,
                 workspace.coarse_quantiles, options_of(coarse_), workspace.model, nullptr);
    result.steps += settled.steps;
    loss_to_beat = settled.loss;
    starts = promising(frame, starts, loss_to_beat, workspace);
  }
  const Descent best =
      best_coarse_descent(frame, starts, options_of(coarse_), workspace, result, trace);
  if (!(best.loss < (1 - worthwhile_gain) * loss_to_beat)) {
    if (!request.incumbent)
      result = no_result(result.steps);
    return result;
  }
  workspace.fine_quantiles.build(workspace.target, fine_.directions, fine_.bins, workspace.model.xi,
                                 workspace.model.bins);
  DescentOptions options = options_of(fine_);
  options.phase = static_cast<int>(starts.size());
  const Descent descent = minimise(frame, best.frame_matrix, free, fine_.cosines,
                                   workspace.fine_quantiles, options, workspace.model, trace);
  result.steps += descent.steps;
  if (request.incumbent && !(descent.loss < result.loss))
    return result;
  result.matrix = frame.to_matrix(descent.frame_matrix);
  result.loss = descent.loss;
  result.outcome = descent.converged ? FitOutcome::converged : FitOutcome::step_limit;
  return result;
}

}  // namespace ltc
