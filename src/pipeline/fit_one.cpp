// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/fit_one.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "align/align.h"
#include "brdf/lobe_model.h"
#include "core/error.h"
#include "fit/lobe_frame.h"
#include "fit/starting_points.h"
#include "judge/held_out.h"
#include "postprocess/normalise.h"
#include "table/reduction.h"

namespace ltc {
namespace {

// The gradient check sorts and differentiates numerically: a few samples show a wrong term as well
// as many, and leave kinks apart.
constexpr std::size_t check_samples = 64;
constexpr std::size_t check_target_samples = 128;
constexpr std::size_t check_directions = 8;

// From the solver's matrix to the table, and what judges it.
void finish(const Config& config, LobeFit& fit) {
  fit.albedo = integrate_albedo(fit.lobe, AlbedoRule());
  HeldOutJudge judge(HeldOutJudge::usual_samples, HeldOutJudge::usual_directions,
                     HeldOutJudge::usual_seed, config.fit.horizon);
  judge.set_lobe(fit.lobe);
  fit.spread = judge.spread();
  fit.aligned = fit.finished.stored = fit.matrix =
      Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  if (has_values(fit.fitted.status)) {
    if (fit.creases.empty()) {
      fit.aligned = align(fit.fitted.matrix);
      fit.finished = post_process(fit.lobe, config.storage, fit.aligned);
    } else {
      fit.aligned = fit.fitted.matrix;
      fit.finished.stored = normalise(
          config.storage, stored_from_matrix(config.storage, fit.fitted.matrix, fit.lobe));
    }
    fit.matrix = matrix_from_stored(config.storage, fit.finished.stored, fit.lobe);
  }
  fit.held_out_loss = judge.loss({fit.matrix, fit.fitted.fold, fit.creases});
  if (fit.ltc)
    fit.ltc_held_out_loss = judge.loss(fit.ltc->matrix);
}

// What is told of a fold, before finish().
void note_fold(const Config& config, const FitRequest& request, FitWorkspace& workspace,
               LobeFit& fit) {
  fit.creases = config.fit.creases();
  if (fit.creases.empty())
    return;
  Lobe bounded = fold(fit.lobe).lobe;
  bounded.alpha_x = std::max(bounded.alpha_x, config.grid.alpha_min);
  bounded.alpha_y = std::max(bounded.alpha_y, config.grid.alpha_min);
  fit.kappa = kappa_of(fit.fitted.fold, bounded);
  FitSettings single = config.fit;
  single.lobe = LobeKind::single;
  fit_entry(*make_solver(single), request, workspace, nullptr, fit.ltc.emplace());
}

}  // namespace

std::vector<bool> entries_behind(const Grid& grid, const std::vector<bool>& needed,
                                 std::size_t flat, int sweeps) {
  const std::vector<PlannedEntry> plan = plan_by_symmetry(grid, needed);
  std::vector<bool> behind(grid.size());
  // What is fitted in the last sweep, then in the one before, …, then in the plain fit. An entry
  // beyond `fitted` may come out wrong in a sweep, for want of neighbours; no later one reads it.
  std::vector<std::size_t> fitted = {plan[flat].representative};
  behind[flat] = behind[fitted.front()] = true;
  std::size_t begin = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const std::size_t end = fitted.size();
    for (; begin < end; ++begin)
      for (const std::size_t neighbour : grid.neighbours(fitted[begin])) {
        if (!needed[neighbour])
          continue;
        behind[neighbour] = true;
        const std::size_t representative = plan[neighbour].representative;
        if (std::find(fitted.begin(), fitted.end(), representative) == fitted.end())
          fitted.push_back(representative);
        behind[representative] = true;
      }
  }
  return behind;
}

LobeFit fit_table_entry(const Config& config, const std::vector<bool>& needed, std::size_t flat,
                        const RunContext& run) {
  if (!needed[flat])
    throw InputError("the entry is not among those that the table needs");
  const Grid& grid = config.grid;
  if (config.fit.lobe == LobeKind::folded)  // its table starts them from a field's values
    return fit_lobe(config, grid.lobe(flat), entry_seed(config.fit.seed, flat), std::nullopt, run);
  const std::size_t representative = plan_by_symmetry(grid, needed)[flat].representative;
  FitWatch watch{representative, {}};
  const std::vector<FittedEntry> entries = fit_table(
      grid, config.fit, entries_behind(grid, needed, flat, sweep_count(config.fit)), run, &watch);
  LobeFit fit;
  fit.lobe = grid.lobe(flat);
  fit.fits = std::move(watch.fits);
  fit.fitted = entries[flat];
  finish(config, fit);
  // A table integrates a lobe once, as its representative sees it.
  fit.albedo = integrate_albedo(grid.lobe(representative), AlbedoRule());
  return fit;
}

LobeFit fit_lobe(const Config& config, const Lobe& lobe, std::uint64_t seed,
                 const std::optional<Eigen::Matrix3d>& start, const RunContext& run) {
  lobe.model->require(lobe);
  FitRequest request;
  request.lobe = lobe;
  request.seed = seed;
  request.progress = run.progress;
  if (start)
    request.starts.push_back(*start);
  LobeFit fit;
  fit.lobe = lobe;
  fit.fits.resize(1);
  const FitWorkspacePointer workspace = make_fit_workspace();
  fit.start_abandoned =
      fit_entry(*make_solver(config.fit), request, *workspace, &fit.fits.front().steps, fit.fitted)
          .start_abandoned;
  note_fold(config, request, *workspace, fit);
  run.throw_if_stopped();
  finish(config, fit);
  return fit;
}

Eigen::Matrix3d starting_matrix(StartKind kind, const Lobe& lobe, std::uint64_t seed) {
  const LobeFrame frame(lobe);
  TargetSamples target;
  sample_weighted_target(frame, make_target_lattice(4096, 0.3), target);
  return frame.to_matrix(start_of_kind(kind, frame, target, seed));
}

GradientCheck check_lobe_gradient(const Lobe& lobe, const Eigen::Matrix3d& matrix, const Fold& fold,
                                  const Creases& creases) {
  const LobeFrame frame(lobe);
  const CosineSet cosines = make_cosine_set(check_samples);
  std::vector<Eigen::Vector3d> omega_o(cosines.size());
  for (std::size_t i = 0; i < cosines.size(); ++i)
    omega_o[i] = folded(Eigen::Vector3d(cosines.x[i], cosines.y[i], cosines.z[i]), fold, creases);
  TargetSamples samples;
  sample_weighted_target(frame, make_target_lattice(check_target_samples, 0.3), samples);
  PointSet target;
  for (std::size_t i = 0; i < samples.size; ++i) {
    target.points.emplace_back(samples.gx[i], samples.gy[i], 1.0 + samples.gz[i]);
    target.weights.push_back(samples.weight[i]);
  }
  // All in the mirror's frame, where the samples are.
  const SlicedWassersteinLoss loss(std::move(omega_o), target,
                                   fibonacci_directions(check_directions));
  const Eigen::Matrix3d in_frame = frame.rotation.transpose() * matrix;
  return check_gradient(loss, in_frame, loss(in_frame).gradient);
}

}  // namespace ltc
