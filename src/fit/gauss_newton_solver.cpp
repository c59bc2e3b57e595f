// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/gauss_newton_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "fit/starting_points.h"
#include "fit/workspace.h"

namespace ltc {
namespace {

// Blocks of neighbouring quantiles a direction: finer ones stop paying and coarser ones begin to
// blur the tails.
std::size_t bins_for(int samples) {
  return static_cast<std::size_t>(std::clamp(samples / 64 / 16 * 16, 32, 256));
}

// A lobe whose loss is r of its spread is fitted with at least this over r samples: the share that
// the lattice's noise has in the loss is then below some 1 %.
constexpr double samples_per_inverse_loss = 30;

// The tolerance of levels that another follows.
constexpr double passing_tolerance = 1e-3;

// A start is descended from, beside an incumbent, when its loss is below this many times the
// incumbent's: one that is worse has never overtaken it.
constexpr double promising_share = 1.5;

// A coarse gain below this share is within the noise of the coarse samples.
constexpr double worthwhile_gain = 2e-3;

// P0's error, relative to the lobe's width, is of the order of alpha/cos^2 theta. Up to this its
// loss, judged by 65,536 samples, is within 2 % of the best fit's and mostly below it, at 0.014 of
// the lobe's spread: less than the samples of a fit can tell.
constexpr double exact_first_order = 2.1e-3;

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

GaussNewtonSolver::Level GaussNewtonSolver::make_level(int samples, int steps, double tolerance,
                                                       double shift) {
  Level level{make_cosine_set(static_cast<std::size_t>(samples), shift), {}};
  level.options.steps = steps;
  level.options.tolerance = tolerance;
  return level;
}

GaussNewtonSolver::GaussNewtonSolver(const GaussNewtonSettings& settings, TargetKind target)
    : settings_(settings),
      target_kind_(target),
      directions_(in_float(fibonacci_directions(static_cast<std::size_t>(settings.directions)))),
      bins_(bins_for(settings.samples)),
      lattice_(make_target_lattice(static_cast<std::size_t>(settings.target_samples), 0.3)),
      light_lattice_(settings.adaptive ? make_target_lattice(static_cast<std::size_t>(std::max(
                                                                 settings.target_samples / 2, 64)),
                                                             0.3)
                                       : lattice_),
      coarse_(make_level(settings.coarse_samples, settings.coarse_steps, settings.coarse_tolerance,
                         0.1)) {
  coarse_.options.direction_stride =
      static_cast<std::size_t>(std::max(1, settings.directions / settings.coarse_directions));
  for (const int divisor : {4, 2, 1}) {
    const int samples = settings.samples / divisor;
    if (divisor > 1 && (!settings.adaptive || samples < settings.coarse_samples))
      continue;
    levels_.push_back(make_level(samples, settings.steps, settings.tolerance, 0.0));
    levels_.back().options.damping = 1e-3;  // it starts next to a minimum
  }
}

void GaussNewtonSolver::see_target(const LobeFrame& frame, std::uint64_t seed,
                                   const TargetLattice& lattice, FitWorkspace& workspace) const {
  if (target_kind_ == TargetKind::weighted)
    sample_weighted_target(frame, lattice, workspace.target);
  else
    sample_rejection_target(frame, lattice.size(), seed, workspace.target);
  workspace.quantiles.build(workspace.target, directions_, bins_, workspace.model.xi,
                            workspace.model.bins);
}

std::size_t GaussNewtonSolver::level_for(double relative_loss) const {
  std::size_t level = 0;
  while (level + 1 < levels_.size() &&
         static_cast<double>(levels_[level].cosines.size()) * relative_loss <
             samples_per_inverse_loss)
    ++level;
  return level;
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
  evaluate_model(frame, p, levels_.back().cosines, workspace.quantiles, 1,
                 workspace.quantiles.spread(), workspace.model, value);
  return {frame.to_matrix(p), value.loss, 0, FitOutcome::analytic};
}

double GaussNewtonSolver::coarse_loss(const LobeFrame& frame, const Eigen::Matrix3d& start,
                                      FitWorkspace& workspace) const {
  ModelValue value;
  evaluate_model(frame, start, coarse_.cosines, workspace.quantiles,
                 coarse_.options.direction_stride, workspace.quantiles.spread(), workspace.model,
                 value);
  return value.loss;
}

Descent GaussNewtonSolver::best_coarse_descent(const LobeFrame& frame,
                                               const std::vector<Eigen::Matrix3d>& starts,
                                               DescentOptions options, FitWorkspace& workspace,
                                               FitResult& result,
                                               std::vector<FitStep>* trace) const {
  const FreeEntries free = free_entries(frame.lobe);
  std::vector<double> losses;
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix3d& start : starts) {
    losses.push_back(usable(start) ? coarse_loss(frame, start, workspace)
                                   : std::numeric_limits<double>::infinity());
    least = std::min(least, losses.back());
  }
  Descent best;
  best.loss = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (!(std::isfinite(losses[i]) && losses[i] <= (1 + settings_.start_margin) * least))
      continue;
    options.phase = static_cast<int>(i);
    const Descent descent = minimise(frame, starts[i], free, coarse_.cosines, workspace.quantiles,
                                     options, workspace.model, trace);
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
  for (const Eigen::Matrix3d& start : starts) {
    if (!usable(start))
      continue;
    const double loss = coarse_loss(frame, start, workspace);
    if (loss < best) {
      best = loss;
      kept.assign(1, start);
    }
  }
  return kept;
}

// From the coarse solution up the levels until the samples suffice for what is left of the loss. A
// lobe that needs the last one passes through the one before, where steps are cheap, and gets a
// target of its own there.
Descent GaussNewtonSolver::climb(const LobeFrame& frame, const FitRequest& request, Descent descent,
                                 DescentOptions watched, FitWorkspace& workspace, FitResult& result,
                                 std::vector<FitStep>* trace) const {
  const FreeEntries free = free_entries(frame.lobe);
  const std::size_t last = levels_.size() - 1;
  std::size_t level = level_for(descent.loss / workspace.quantiles.spread());
  if (level == last && last > 0)
    --level;
  for (;; ++level) {
    DescentOptions options = levels_[level].options;
    options.begin = watched.begin;
    options.progress = watched.progress;
    options.phase = watched.phase++;
    const bool passing =
        level < last && level_for(descent.loss / workspace.quantiles.spread()) > level;
    if (passing)
      options.tolerance = std::max(options.tolerance, passing_tolerance);
    descent = minimise(frame, descent.frame_matrix, free, levels_[level].cosines,
                       workspace.quantiles, options, workspace.model, trace);
    result.steps += descent.steps;
    if (level == last || level_for(descent.loss / workspace.quantiles.spread()) <= level)
      return descent;
    if (level + 1 == last)
      see_target(frame, request.seed, lattice_, workspace);
  }
}

FitResult GaussNewtonSolver::fit(const FitRequest& request, FitWorkspace& workspace,
                                 std::vector<FitStep>* trace) const {
  const LobeFrame frame(request.lobe);
  const FreeEntries free = free_entries(request.lobe);
  DescentOptions options = coarse_.options;
  options.begin = std::chrono::steady_clock::now();
  options.progress = request.progress;
  see_target(frame, request.seed, light_lattice_, workspace);
  if (request.starts.empty() && first_order_is_exact(frame))
    return analytic_result(frame, workspace);

  std::vector<Eigen::Matrix3d> starts;
  for (const Eigen::Matrix3d& matrix : request.starts)
    starts.push_back(admissible(frame.from_matrix(matrix), free));
  if (starts.empty())
    starts = own_starts(frame, request.seed, workspace);

  FitResult result;
  double loss_to_beat = std::numeric_limits<double>::infinity();
  if (request.incumbent) {
    result = *request.incumbent;
    // The incumbent settles on the coarse samples before it is compared on them.
    const Descent settled =
        minimise(frame, admissible(frame.from_matrix(result.matrix), free), free, coarse_.cosines,
                 workspace.quantiles, options, workspace.model, nullptr);
    result.steps = settled.steps;
    loss_to_beat = settled.loss;
    starts = promising(frame, starts, loss_to_beat, workspace);
  }
  const Descent best = best_coarse_descent(frame, starts, options, workspace, result, trace);
  if (!(best.loss < (1 - worthwhile_gain) * loss_to_beat)) {
    if (!request.incumbent)
      result = no_result(result.steps);
    return result;
  }
  options.phase = static_cast<int>(starts.size());
  const Descent descent = climb(frame, request, best, options, workspace, result, trace);
  if (request.incumbent && !(descent.loss < result.loss))
    return result;
  result.matrix = frame.to_matrix(descent.frame_matrix);
  result.loss = descent.loss;
  result.outcome = descent.converged ? FitOutcome::converged : FitOutcome::step_limit;
  return result;
}

}  // namespace ltc
