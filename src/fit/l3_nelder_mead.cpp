// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/l3_nelder_mead.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <nlopt.hpp>

#include "core/stopwatch.h"
#include "fit/starting_points.h"

namespace ltc {
namespace {

constexpr double first_simplex = 0.1;

// The free entries of P as a vector, and back.
class FreeVariables {
 public:
  explicit FreeVariables(const FreeEntries& free) {
    for (int entry = 0; entry < 9; ++entry)
      if (free[entry])
        entries_.push_back(entry);
  }
  std::vector<double> of(const Eigen::Matrix3d& frame_matrix) const {
    std::vector<double> values;
    for (const int entry : entries_)
      values.push_back(frame_matrix(entry / 3, entry % 3));
    return values;
  }
  Eigen::Matrix3d matrix(const std::vector<double>& values) const {
    Eigen::Matrix3d frame_matrix = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < entries_.size(); ++i)
      frame_matrix(entries_[i] / 3, entries_[i] % 3) = values[i];
    return frame_matrix;
  }

 private:
  std::vector<int> entries_;
};

// What NLopt calls back; keeps the best that it saw.
struct Objective {
  const LobeFrame& frame;
  const FreeVariables& variables;
  const L3Error& error;
  const Progress* progress;
  std::vector<FitStep>* trace;
  nlopt::opt& optimiser;
  Clock::time_point begin = Clock::now();
  std::vector<double> best = {};
  double best_error = std::numeric_limits<double>::infinity();
  int evaluations = 0;

  double evaluate(const std::vector<double>& values) {
    if (progress && progress->stop_requested())
      optimiser.force_stop();
    const double value = error(frame.to_matrix(variables.matrix(values)));
    const bool better = value < best_error;
    if (better) {
      best = values;
      best_error = value;
    }
    ++evaluations;
    if (trace)
      trace->push_back({value, 0, 0, seconds_since(begin), better});
    return value;
  }
};

}  // namespace

SimplexSearch search_by_simplex(const LobeFrame& frame, const Eigen::Matrix3d& start,
                                const FreeEntries& free, const L3Error& error,
                                const L3Settings& settings, const Progress* progress,
                                std::vector<FitStep>* trace) {
  // A simplex has no extent along a column that is zero, and none at all where it is not finite.
  if (!start.allFinite() || !(start.colwise().squaredNorm().minCoeff() > 0))
    return {start, std::numeric_limits<double>::infinity(), 0, false};
  const FreeVariables variables(free);
  std::vector<double> values = variables.of(start);
  Eigen::Matrix3d steps;
  steps.rowwise() = first_simplex * start.colwise().norm();

  nlopt::opt optimiser(nlopt::LN_NELDERMEAD, static_cast<unsigned>(values.size()));
  Objective objective{frame, variables, error, progress, trace, optimiser};
  objective.best = values;
  optimiser.set_min_objective(
      [](const std::vector<double>& at, std::vector<double>&, void* self) {
        return static_cast<Objective*>(self)->evaluate(at);
      },
      &objective);
  optimiser.set_initial_step(variables.of(steps));
  optimiser.set_maxeval(settings.evaluations);
  optimiser.set_ftol_rel(settings.tolerance);
  SimplexSearch result;
  try {
    double unused;
    result.converged = optimiser.optimize(values, unused) == nlopt::FTOL_REACHED;
  } catch (const nlopt::roundoff_limited&) {
    result.converged = true;  // as far as digits go
  } catch (const nlopt::forced_stop&) {
    // asked for: what there is
  }
  result.frame_matrix = admissible(variables.matrix(objective.best), free);
  result.error = objective.best_error;
  result.evaluations = objective.evaluations;
  return result;
}

L3NelderMeadSolver::L3NelderMeadSolver(const L3Settings& settings)
    : settings_(settings),
      cosines_(make_cosine_set(static_cast<std::size_t>(settings.samples))),
      lattice_(make_target_lattice(static_cast<std::size_t>(settings.samples), 0.3)) {}

FitResult L3NelderMeadSolver::fit(const FitRequest& request, FitWorkspace& workspace,
                                  std::vector<FitStep>* trace) const {
  const LobeFrame frame(request.lobe);
  const FreeEntries free = free_entries(request.lobe);
  meter_.set_target(frame, workspace);
  const Eigen::Matrix3d start =
      request.starts.empty() ? start_of_kind(settings_.start, frame, workspace.target, request.seed)
                             : admissible(frame.from_matrix(request.starts.front()), free);
  const L3Error error = lobe_l3_error(
      request.lobe, integrate_albedo(request.lobe, albedo_rule_).amplitude, lattice_, cosines_);
  const SimplexSearch search =
      search_by_simplex(frame, start, free, error, settings_, request.progress, trace);

  FitResult result;
  result.steps = search.evaluations;
  result.outcome = search.converged ? FitOutcome::converged : FitOutcome::step_limit;
  result.matrix = frame.to_matrix(search.frame_matrix);
  result.loss = std::isfinite(search.error) ? meter_.loss(frame, search.frame_matrix, workspace)
                                            : std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(result.loss) || !(result.matrix.determinant() > 0)) {
    result.matrix.setConstant(std::numeric_limits<double>::quiet_NaN());
    result.loss = std::numeric_limits<double>::quiet_NaN();
    result.outcome = FitOutcome::non_finite;
  }
  return result;
}

}  // namespace ltc
