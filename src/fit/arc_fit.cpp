// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/arc_fit.h"

#include <algorithm>

#include "fit/lobe_class.h"
#include "fit/starting_points.h"

namespace ltc {
namespace {

// The larger roughness of the sharpest lobes that are fitted by arcs, and the smaller over the
// larger one of the thinnest. Sharper and thinner ones than a coarse grid's first nodes are most of
// a fine grid's fits, and a fit on samples takes six times as long.
constexpr double least_alpha = 0.05, least_ratio = 0.05;
// Of sharp lobes the isotropic ones are those that an LTC comes nearest to: no threshold tells what
// it misses of them.
constexpr double most_ratio_of_sharp = 0.9;

constexpr std::size_t coarse_samples = 1024, arc_nodes = 8;

// Damping that falls further than this makes steps that are taken back: three of ten.
constexpr double least_damping = 0.1;

// What settings say of samples, arcs reach with less of: an eighth fewer directions, with as many
// thresholds each, and half the samples of the lobe; more gains less than 0.1 % of the loss.
// Coarsely three eighths of the directions.
std::size_t fine_count(const GaussNewtonSettings& settings) {
  return static_cast<std::size_t>(std::max(4, 7 * settings.directions / 8));
}
std::size_t coarse_count(const GaussNewtonSettings& settings) {
  return static_cast<std::size_t>(std::max(4, 3 * settings.directions / 8));
}
std::size_t sample_count(const GaussNewtonSettings& settings) {
  return static_cast<std::size_t>(std::max(64, settings.target_samples / 2));
}

// The last gains of a descent are the noise of its samples: as a multiple of the tolerance that is
// asked for.
constexpr double tolerance_factor = 3;

}  // namespace

ArcFit::ArcFit(const GaussNewtonSettings& settings)
    : coarse_{make_target_lattice(coarse_samples, 0.3),
              {},
              ArcRule(coarse_count(settings), arc_nodes),
              {}},
      fine_{make_target_lattice(sample_count(settings), 0.3),
            {},
            ArcRule(fine_count(settings), arc_nodes),
            {}} {
  coarse_.directions = in_float(fibonacci_directions(coarse_count(settings)));
  coarse_.options.steps = settings.coarse_steps;
  coarse_.options.tolerance = settings.coarse_tolerance;
  fine_.directions = in_float(fibonacci_directions(fine_count(settings)));
  fine_.options.steps = settings.steps;
  fine_.options.tolerance = std::min(1.0, tolerance_factor * settings.tolerance);
  fine_.options.damping = least_damping;
  for (Level* level : {&coarse_, &fine_})
    level->options.least_damping = least_damping;
}

bool ArcFit::takes(const LobeFrame& frame) {
  const double x = frame.lobe.alpha_x, y = frame.lobe.alpha_y;
  const double larger = std::max(x, y), ratio = std::min(x, y) / larger;
  return !is_extreme(frame) && larger >= least_alpha && ratio >= least_ratio &&
         !(is_sharp(frame) && ratio > most_ratio_of_sharp);
}

Descent ArcFit::descend(const Level& level, const Request& request, const Eigen::Matrix3d& start,
                        FitPhase phase) const {
  FitWorkspace& workspace = request.workspace;
  set_target(workspace.target, level.directions, level.rule, workspace.model.xi,
             workspace.arc_target);
  DescentOptions options = level.options;
  options.begin = request.begin;
  options.phase = phase;
  options.progress = request.fit.progress;
  const ArcTask arcs{{level.directions, level.rule, workspace.arc_target}, workspace.arcs};
  return minimise({request.frame, start, request.free, arcs}, options, workspace.model,
                  request.trace);
}

FitResult ArcFit::fit(const FitRequest& fit, const LobeFrame& frame, FitWorkspace& workspace,
                      std::vector<FitStep>* trace) const {
  const Request request{
      fit, frame, free_entries(frame.lobe), std::chrono::steady_clock::now(), workspace, trace};
  int steps = 0;
  Eigen::Matrix3d start;
  if (fit.near) {
    start = admissible(frame.from_matrix(*fit.near), request.free);
  } else {
    sample_weighted_target(frame, coarse_.lattice, workspace.target);
    const Descent coarse = descend(coarse_, request, moment_start(frame, workspace.target),
                                   {FitPhase::Kind::own_start, 0});
    start = coarse.frame_matrix;
    steps = coarse.steps;
  }
  sample_weighted_target(frame, fine_.lattice, workspace.target);
  const Descent fine = descend(fine_, request, start, {FitPhase::Kind::fine, 0});
  return {frame.to_matrix(fine.frame_matrix), fine.loss, steps + fine.steps,
          fine.converged ? FitOutcome::converged : FitOutcome::step_limit};
}

}  // namespace ltc
