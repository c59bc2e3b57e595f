// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/gauss_newton_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "field/field.h"
#include "fit/fold_starts.h"
#include "fit/lobe_class.h"
#include "fit/starting_points.h"
#include "fit/workspace.h"

namespace ltc {
namespace {

// The tolerance of levels that another follows.
constexpr double passing_tolerance = 1e-3;

// A start is descended from, beside an incumbent, when its loss is below this many times the
// incumbent's: one that is worse has never overtaken it.
constexpr double promising_share = 1.5;

// Of descents from near the solution: with less damping they take back steps, and what more of them
// would gain is noise.
constexpr double near_damping = 0.1, near_tolerance = 3e-4;

// A coarse gain below this share is within the noise of the coarse samples.
constexpr double worthwhile_gain = 2e-3;

// How many starts extreme lobes get at least.
constexpr int starts_at_extremes = 8;
// And sharp ones: P0 must be among them.
constexpr int starts_of_sharp = 2;

// A given start is abandoned where it ends this share above the solver's own.
constexpr double clearly_worse = 2e-3;

// Coarse solutions up to this many times the least may overtake it on fine samples; at most so many
// are tried.
constexpr double rival_share = 1.5;
constexpr std::size_t most_rivals = 4;

// Nearer to the horizon than this the tails of a lobe may outweigh it; where the loss on more
// samples is larger by this share, a fit has followed those that it had.
constexpr double heavy_tailed_cosine = 0.1, overfit_share = 0.03;

// What the widths of lobes may differ by for want of samples, as a share of the spread.
constexpr double width_noise = 0.1;

bool usable(const Eigen::Matrix3d& start) {
  return start.allFinite() && start.determinant() > 0;
}

// Folds converge slowly: with as many steps as an LTC they end 3 % above the least loss.
constexpr int fold_step_factor = 3;

FitResult no_result(int steps) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {Eigen::Matrix3d::Constant(nan), nan, steps, FitOutcome::non_finite};
}

}  // namespace

GaussNewtonSolver::GaussNewtonSolver(const GaussNewtonSettings& settings, TargetKind target,
                                     const Creases& creases, HorizonMode horizon)
    : settings_(settings),
      target_kind_(target),
      creases_(creases),
      directions_(in_float(fibonacci_directions(static_cast<std::size_t>(settings.directions)))),
      bins_(bins_for(settings.samples)),
      usual_(make_ladder(settings, creases, horizon)),
      graded_(make_graded_ladder(settings, creases, horizon)) {
  // Settings that ask for more than one start are tried by samples.
  if (settings.loss == LossKind::arcs && target == TargetKind::weighted &&
      horizon == HorizonMode::clipped && settings.starts == 1)
    arcs_.emplace(settings);
}

const SampleLadder& GaussNewtonSolver::ladder_for(const LobeFrame& frame) const {
  return target_kind_ == TargetKind::weighted && (is_extreme(frame) || is_sharp(frame)) ? graded_
                                                                                        : usual_;
}

void GaussNewtonSolver::see_target(const LobeFrame& frame, std::uint64_t seed, Look look,
                                   FitWorkspace& workspace) const {
  const SampleLadder& ladder = ladder_for(frame);
  const TargetLattice& lattice = look == Look::whole ? ladder.lattice : ladder.light_lattice;
  if (&ladder == &graded_)
    sample_graded_target(frame,
                         look == Look::whole ? ladder.graded_lattice : ladder.graded_light_lattice,
                         workspace.target);
  else if (target_kind_ == TargetKind::weighted)
    sample_weighted_target(frame, lattice, workspace.target);
  else
    sample_rejection_target(frame, lattice.size(), seed, workspace.target);
  workspace.quantiles.build(workspace.target, directions_, bins_, workspace.model.xi,
                            workspace.model.bins, ladder.spacing);
}

std::vector<Eigen::Matrix3d> GaussNewtonSolver::own_starts(const LobeFrame& frame,
                                                           std::uint64_t seed,
                                                           const FitWorkspace& workspace) const {
  const int count = std::max(settings_.starts, is_extreme(frame) ? starts_at_extremes
                                               : is_sharp(frame) ? starts_of_sharp
                                                                 : 1);
  std::vector<Eigen::Matrix3d> starts = {moment_start(frame, workspace.target),
                                         first_order_start(frame), identity_start(frame)};
  for (int i = 3; i < count; ++i)
    starts.push_back(random_start(frame, workspace.target, seed + static_cast<std::uint64_t>(i)));
  starts.resize(static_cast<std::size_t>(count));
  return starts;
}

// One request under way.
class GaussNewtonSolver::Fit {
 public:
  Fit(const GaussNewtonSolver& solver, const FitRequest& request, FitWorkspace& workspace,
      std::vector<FitStep>* trace)
      : solver_(solver),
        request_(request),
        workspace_(workspace),
        trace_(trace),
        frame_(request.lobe),
        free_(free_entries(request.lobe)),
        ladder_(solver.ladder_for(frame_)) {}

  FitResult run() {
    if (solver_.creases_.empty())
      return find_ltc();
    const FitResult at_hand = request_.incumbent ? *request_.incumbent : find_ltc();
    return can_fold(at_hand) ? folded(at_hand) : at_hand;
  }

 private:
  using Kind = FitPhase::Kind;

  // A coarse solution that the fine phase may go on from.
  struct Candidate {
    Descent descent;
    bool given = false;
    double loss = 0;  // honest
  };

  FitResult find_ltc() {
    if (const std::optional<FitResult> found = fit_by_arcs())
      return *found;
    see_target(Look::light);
    if ((request_.starts.empty() || !request_.incumbent) && first_order_is_exact(frame_)) {
      FitResult result = analytic_result();
      result.start_abandoned = !request_.starts.empty();
      return result;
    }
    return request_.incumbent ? improve(*request_.incumbent) : fit_anew();
  }

  // Before any target is seen. None where a lobe is not for arcs, or they find nothing.
  std::optional<FitResult> fit_by_arcs() {
    if (!solver_.arcs_ || !request_.starts.empty() || request_.incumbent ||
        !ArcFit::takes(frame_) || first_order_is_exact(frame_))
      return std::nullopt;
    const FitResult found = solver_.arcs_->fit(request_, frame_, workspace_, trace_);
    if (!usable(found.matrix) || !std::isfinite(found.loss))
      return std::nullopt;
    return found;
  }

  bool can_fold(const FitResult& at_hand) const {
    return at_hand.outcome != FitOutcome::analytic && at_hand.outcome != FitOutcome::non_finite &&
           frame_.lobe.alpha_x != frame_.lobe.alpha_y;
  }

  FitResult folded(const FitResult& at_hand) {
    result_ = at_hand;
    folding_ = true;
    if (!seen_)
      see_target(Look::light);
    std::vector<Descent> descents;
    for (const Descent& start :
         fold_starts(frame_, at_hand, request_.folded_starts, solver_.creases_)) {
      const FitPhase phase{Kind::fold, static_cast<int>(descents.size())};
      descents.push_back(descend(ladder_.coarse, start, options_of(ladder_.coarse, phase)));
      result_.steps += descents.back().steps;
    }
    FitResult found = climbed(best_of(descents));
    if (fine_loss(found) < fine_loss(at_hand))
      return found;
    found = at_hand;
    found.steps = result_.steps;
    return found;
  }

  FitResult analytic_result() {
    const Eigen::Matrix3d p = admissible(frame_.first_order, free_);
    return {frame_.to_matrix(p), loss_on(solver_.usual_.levels.back(), {p}), 0,
            FitOutcome::analytic};
  }

  FitResult fit_anew() {
    if (request_.near && !is_extreme(frame_)) {
      Descent near{admissible(frame_.from_matrix(*request_.near), free_)};
      near.loss = coarse_loss(near.frame_matrix);
      if (std::isfinite(near.loss))
        return climbed(near);
    }
    if (request_.starts.empty() && &ladder_ == &solver_.usual_) {
      const Descent best = best_of(coarse_descents(own_starts(), Kind::own_start));
      return std::isfinite(best.loss) ? climbed(best) : no_result(result_.steps);
    }
    std::vector<Candidate> candidates;
    for (const Descent& descent : coarse_descents(widened(given_starts()), Kind::given_start))
      candidates.push_back({descent, true, honest_loss(descent)});
    for (const Descent& descent : coarse_descents(own_starts(), Kind::own_start))
      candidates.push_back({descent, false, honest_loss(descent)});
    keep_rivals(candidates);
    return best_climbed(candidates);
  }

  // The best few, which the coarse samples cannot tell apart for certain.
  static void keep_rivals(std::vector<Candidate>& candidates) {
    std::erase_if(candidates, [](const Candidate& c) { return !std::isfinite(c.loss); });
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.loss < b.loss; });
    std::erase_if(candidates, [least = candidates.empty() ? 0 : candidates.front().loss](
                                  const Candidate& c) { return c.loss > rival_share * least; });
    if (candidates.size() > most_rivals)
      candidates.resize(most_rivals);
  }

  FitResult best_climbed(const std::vector<Candidate>& candidates) {
    FitResult best = no_result(result_.steps);
    double least = std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : candidates) {
      FitResult result = climbed(candidate.descent);
      result.start_abandoned = !request_.starts.empty() && !candidate.given;
      const double loss = fine_loss(result) * (candidate.given ? 1 - clearly_worse : 1);
      if (loss < least) {
        least = loss;
        best = result;
      }
    }
    best.steps = result_.steps;
    return best;
  }

  // On the last level, whichever the climb ended on.
  double fine_loss(const FitResult& result) {
    see_target(Look::whole);
    return loss_on(ladder_.levels.back(),
                   {frame_.from_matrix(result.matrix), bend_of(frame_, result.fold)});
  }

  // From the neighbours' solutions, where they promise more than what there is.
  FitResult improve(const FitResult& incumbent) {
    result_ = incumbent;
    // The incumbent settles on the coarse samples before it is compared on them.
    const Descent settled =
        descend(ladder_.coarse, {admissible(frame_.from_matrix(incumbent.matrix), free_)},
                options_of(ladder_.coarse, {}), nullptr);
    result_.steps = settled.steps;
    const bool given = !request_.starts.empty();
    const Descent best =
        best_of(coarse_descents(promising(given ? given_starts() : own_starts(), settled.loss),
                                given ? Kind::given_start : Kind::own_start));
    if (!(best.loss < (1 - worthwhile_gain) * settled.loss))
      return result_;
    FitResult improved = climbed(best);
    if (improved.loss < incumbent.loss)
      return improved;
    result_.steps = improved.steps;
    return result_;
  }

  // Nothing where the workspace holds just that.
  void see_target(Look look) {
    if (seen_ == look)
      return;
    solver_.see_target(frame_, request_.seed, look, workspace_);
    seen_ = look;
  }

  DescentOptions options_of(const SampleLevel& level, FitPhase phase) const {
    DescentOptions options = level.options;
    options.begin = begin_;
    options.progress = request_.progress;
    options.phase = phase;
    return options;
  }

  std::vector<Eigen::Matrix3d> given_starts() const {
    std::vector<Eigen::Matrix3d> starts;
    for (const Eigen::Matrix3d& matrix : request_.starts)
      starts.push_back(repaired(frame_, matrix));
    return starts;
  }
  std::vector<Eigen::Matrix3d> own_starts() const {
    return solver_.own_starts(frame_, request_.seed, workspace_);
  }

  double loss_on(const SampleLevel& level, const Descent& at) {
    const ModelPoint point{frame_,
                           at.frame_matrix,
                           level.cosines,
                           workspace_.quantiles,
                           level.options.direction_stride,
                           workspace_.quantiles.spread()};
    if (at.bend.isZero(0)) {
      ModelValue value;
      evaluate_model(point, workspace_.model, value);
      return value.loss;
    }
    FoldedModelValue value;
    evaluate_model(point, {column_of(at.frame_matrix, at.bend), level.u}, workspace_.model, value);
    return value.loss;
  }
  double coarse_loss(const Eigen::Matrix3d& start) { return loss_on(ladder_.coarse, {start}); }

  Descent descend(const SampleLevel& level, const Descent& from, const DescentOptions& options,
                  std::vector<FitStep>* trace) {
    const FoldTask fold{from.bend, free_fold_, most_fold(solver_.creases_), level.u};
    return minimise({frame_, from.frame_matrix, free_, level.cosines, workspace_.quantiles,
                     folding_ ? &fold : nullptr},
                    options, workspace_.model, trace);
  }
  Descent descend(const SampleLevel& level, const Descent& from, const DescentOptions& options) {
    return descend(level, from, options, trace_);
  }

  // The coarse loss, or what the widths alone make it at least. The model compares means of bins,
  // so that it takes a lobe far narrower than a bin for a good one wherever its mean is right; but
  // for every centre c the distance of X and Y is at least |E|X - c| - E|Y - c||.
  double honest_loss(const Descent& descent) {
    if (!std::isfinite(descent.loss))
      return descent.loss;
    coarse_loss(descent.frame_matrix);  // transforms the samples
    const ModelWorkspace& model = workspace_.model;
    const std::size_t stride = ladder_.coarse.options.direction_stride;
    const CosineSet& cosines = ladder_.coarse.cosines;
    const std::size_t count = cosines.size();
    const auto total = static_cast<double>(cosines.total());
    const auto multiplicity = [&](std::size_t i) {
      return cosines.multiplicity.empty() ? 1.0 : cosines.multiplicity[i];
    };
    double difference = 0;
    std::size_t directions = 0;
    for (std::size_t k = 0; k < workspace_.quantiles.direction_count(); k += stride, ++directions) {
      const kernels::ProjectionMap& map = workspace_.quantiles.map(k);
      double deviation = 0;
      for (std::size_t i = 0; i < count; ++i)
        deviation += multiplicity(i) *
                     std::abs(map.direction_x * model.gx[i] + map.direction_y * model.gy[i] +
                              map.direction_z * model.gz[i] - map.centre);
      difference += std::abs(deviation / total - 1 / map.inverse_scale);
    }
    const double least =
        difference / static_cast<double>(directions) - width_noise * workspace_.quantiles.spread();
    return std::max(descent.loss, least);
  }

  // From every start whose loss is not hopeless beside the least.
  std::vector<Descent> coarse_descents(const std::vector<Eigen::Matrix3d>& starts, Kind kind) {
    std::vector<double> losses;
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::Matrix3d& start : starts) {
      losses.push_back(usable(start) ? coarse_loss(start)
                                     : std::numeric_limits<double>::infinity());
      least = std::min(least, losses.back());
    }
    const double most = is_extreme(frame_) ? std::numeric_limits<double>::max()
                                           : (1 + solver_.settings_.start_margin) * least;
    std::vector<Descent> descents;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      if (!(std::isfinite(losses[i]) && losses[i] <= most))
        continue;
      descents.push_back(descend(ladder_.coarse, {starts[i]},
                                 options_of(ladder_.coarse, {kind, static_cast<int>(i)})));
      result_.steps += descents.back().steps;
    }
    return descents;
  }

  // Of infinite loss where there is none.
  static Descent best_of(const std::vector<Descent>& descents) {
    Descent best;
    best.loss = std::numeric_limits<double>::infinity();
    for (const Descent& descent : descents)
      if (descent.loss < best.loss)
        best = descent;
    return best;
  }

  // A start that would fall into a single bin, where the model sees only its mean, starts a tenth
  // as wide as the lobe instead.
  std::vector<Eigen::Matrix3d> widened(std::vector<Eigen::Matrix3d> starts) const {
    constexpr double narrowest = 0.1;
    const double lobe_width = width(moment_start(frame_, workspace_.target));
    for (Eigen::Matrix3d& start : starts)
      if (const double share = width(start) / lobe_width; share < narrowest && share > 0)
        start.leftCols<2>() *= narrowest / share;
    return starts;
  }
  // Of the wider of its two columns.
  double width(const Eigen::Matrix3d& p) const {
    return std::max(frame_.widths.x() * p.col(0).norm(), frame_.widths.y() * p.col(1).norm()) /
           p.col(2).norm();
  }

  // The start of least loss, where that is not hopeless beside `loss_to_beat`; none otherwise.
  std::vector<Eigen::Matrix3d> promising(const std::vector<Eigen::Matrix3d>& starts,
                                         double loss_to_beat) {
    std::vector<Eigen::Matrix3d> kept;
    double best = promising_share * loss_to_beat;
    for (const Eigen::Matrix3d& start : starts) {
      if (!usable(start))
        continue;
      const double loss = coarse_loss(start);
      if (loss < best) {
        best = loss;
        kept.assign(1, start);
      }
    }
    return kept;
  }

  FitResult climbed(const Descent& coarse) {
    const Descent descent = climb(coarse);
    FitResult result = result_;
    result.matrix = frame_.to_matrix(descent.frame_matrix);
    result.fold = fold_of(frame_, descent.bend);
    result.loss = descent.loss;
    result.outcome = descent.converged ? FitOutcome::converged : FitOutcome::step_limit;
    return result;
  }

  // From the coarse solution up the levels until the samples suffice for what is left of the loss.
  // A lobe that needs the last one passes through the one before, where steps are cheap, and gets a
  // target of its own there.
  Descent climb(Descent descent) {
    see_target(&ladder_ == &solver_.graded_ ? Look::whole : Look::light);
    const std::vector<SampleLevel>& levels = ladder_.levels;
    const std::size_t last = levels.size() - 1;
    std::size_t level = level_needed(descent);
    if (level == last && last > 0)
      --level;
    for (int phase = 0;; ++level, ++phase) {
      DescentOptions options =
          options_of(levels[level], {folding_ ? Kind::fine_fold : Kind::fine, phase});
      if (folding_)
        options.steps *= fold_step_factor;
      if (request_.near) {
        options.damping = options.least_damping = near_damping;
        options.tolerance = std::max(options.tolerance, near_tolerance);
      }
      if (level < last && level_needed(descent) > level)
        options.tolerance = std::max(options.tolerance, passing_tolerance);
      descent = descend(levels[level], descent, options);
      result_.steps += descent.steps;
      if (level == last ||
          (level_needed(descent) <= level && !is_overfitted(descent, levels[level + 1])))
        return descent;
      if (level + 1 == last)
        see_target(Look::whole);
    }
  }
  bool is_overfitted(const Descent& descent, const SampleLevel& next) {
    return frame_.omega_v.z() < heavy_tailed_cosine &&
           loss_on(next, descent) > (1 + overfit_share) * descent.loss;
  }
  std::size_t level_needed(const Descent& descent) const {
    return level_for(ladder_, descent.loss / workspace_.quantiles.spread());
  }

  const GaussNewtonSolver& solver_;
  const FitRequest& request_;
  FitWorkspace& workspace_;
  std::vector<FitStep>* trace_;
  LobeFrame frame_;
  FreeEntries free_;
  const SampleLadder& ladder_;
  bool folding_ = false;
  const std::array<bool, 2> free_fold_ = free_fold(frame_.lobe);
  std::optional<Look> seen_;  // what the workspace's target is
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  FitResult result_;
};

FitResult GaussNewtonSolver::fit(const FitRequest& request, FitWorkspace& workspace,
                                 std::vector<FitStep>* trace) const {
  if (creases_.empty())
    return Fit(*this, request, workspace, trace).run();
  const QuadrantImage image(request);
  return image.unfolded(Fit(*this, image.request(), workspace, trace).run());
}

}  // namespace ltc
