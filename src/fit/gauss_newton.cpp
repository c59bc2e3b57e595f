// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/gauss_newton.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>

#include "brdf/lobe_model.h"
#include "core/stopwatch.h"

namespace ltc {
namespace {

// The prior: columns 0 and 1 of P A, less those of P0 A, squared and relative to the width of the
// first-order lobe, count the prior's weight times the lobe's spread where the spread is below
// `prior_spread`, and less by its square ratio in wider lobes. P differs from P0 by the order of
// the roughness, and with a few thousand samples the tails of a sharp lobe, which are all that row
// 3 moves, are left open.
constexpr double prior_spread = 1.5e-3;

// Smoothing e of the reweighting, as a share of the loss: below it a residual counts as zero.
// With five times as much some fits ended a twentieth above the least loss.
constexpr double smoothing_share = 0.01;

// Of the squared entries of column c of P - P0; see prior_spread.
double prior_strength(const LobeFrame& frame, double spread, int column, double weight) {
  const double width = std::max(frame.widths[0] * frame.first_order.col(0).norm(),
                                frame.widths[1] * frame.first_order.col(1).norm());
  const double wide = spread / prior_spread, relative = frame.widths[column] / width;
  return weight * spread / (1 + wide * wide) * relative * relative;
}

// The same of a bend's two numbers: a fold moves samples by about q.
Bend bend_strength(const LobeFrame& frame, double spread, double weight) {
  return {prior_strength(frame, spread, 1, weight) * frame.first_order.col(1).squaredNorm(),
          prior_strength(frame, spread, 2, weight)};
}

// P, and the bend where lobes are folded.
struct Place {
  Eigen::Matrix3d p;
  Bend bend = Bend::Zero();
};

// A place as so many numbers: nine of P, and two of the bend.
template <int numbers>
using Numbers = Eigen::Matrix<double, numbers, 1>;
template <int numbers>
Numbers<numbers> difference(const Place& to, const Place& from) {
  Numbers<numbers> result;
  result.template head<9>() = flattened(to.p - from.p);
  if constexpr (numbers > 9)
    result.template tail<2>() = to.bend - from.bend;
  return result;
}

// Adds the prior to the model at a place, and returns its own value.
template <int numbers>
double add_prior(const LobeFrame& frame, double spread, const Place& at, double weight,
                 ModelValueOf<numbers>& value) {
  for (int column = 0; column < 2; ++column) {
    const double strength = prior_strength(frame, spread, column, weight);
    for (int row = 0; row < 3; ++row) {
      const int entry = 3 * row + column;
      value.gradient[entry] += strength * (at.p(row, column) - frame.first_order(row, column));
      value.curvature(entry, entry) += strength;
    }
  }
  if constexpr (numbers > 9) {
    const Bend strength = bend_strength(frame, spread, weight);
    value.gradient.template tail<2>() += strength.cwiseProduct(at.bend);
    value.curvature.diagonal().template tail<2>() += strength;
  }
  return prior(frame, spread, at.p, weight, at.bend);
}

// An entry's own curvature counts at least this share of its column's.
constexpr double least_own_curvature = 1e-9;

// The damped step over the free entries. Damping is relative to each entry's own curvature: row 2
// of a thin column has a curvature of the roughness squared of its column's, and would not move if
// damped like that. Scale and rotation, which move nothing, are held by damping alone.
template <int numbers>
Numbers<numbers> damped_step(const ModelValueOf<numbers>& value,
                             const std::array<bool, numbers>& free, double damping) {
  int index[numbers], count = 0;
  for (int entry = 0; entry < numbers; ++entry)
    if (free[static_cast<std::size_t>(entry)])
      index[count++] = entry;
  double column_curvature[3] = {};
  for (int entry = 0; entry < 9; ++entry)
    column_curvature[entry % 3] += value.curvature(entry, entry) / 3;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, numbers, numbers> system(count, count);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, numbers, 1> right(count), scale(count);
  for (int i = 0; i < count; ++i) {
    const int column = index[i] < 9 ? index[i] % 3 : 2;
    scale[i] = 1 / std::sqrt(std::max(value.curvature(index[i], index[i]),
                                      least_own_curvature * column_curvature[column]));
  }
  // Scaled to a unit diagonal, so that columns of very different roughness keep their digits.
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j)
      system(i, j) = value.curvature(index[i], index[j]) * scale[i] * scale[j];
    system(i, i) += damping;
    right[i] = -value.gradient[index[i]] * scale[i];
  }
  const auto solution = system.ldlt().solve(right).eval();
  Numbers<numbers> step = Numbers<numbers>::Zero();
  for (int i = 0; i < count; ++i)
    step[index[i]] = solution[i] * scale[i];
  return step;
}

// A lobe much thinner than it is wide is a line to its samples: they hardly feel the length of the
// thin column, and a step that turns it round may leave it anywhere near zero. A column shorter
// than this share of the first-order lobe's is lengthened where M has a larger condition number
// than this, half of where single precision cannot invert it.
constexpr double short_column_share = 0.005, most_condition = 5e6;

void lengthen_vanishing_columns(const LobeFrame& frame, Place& place) {
  Eigen::Matrix3d& p = place.p;
  const Eigen::Vector3d singular =
      Eigen::JacobiSVD<Eigen::Matrix3d>(p * frame.widths.asDiagonal()).singularValues();
  const double excess = singular[0] / singular[2] / most_condition;
  if (!(excess > 1))
    return;
  for (int column = 0; column < 2; ++column) {
    const double length = p.col(column).norm();
    const double least = short_column_share * frame.first_order.col(column).norm();
    if (!(length > 0 && length < least))
      continue;
    const double factor = std::min(excess, least / length);
    p.col(column) *= factor;
    if (column == 1)
      place.bend[0] /= factor;  // what is bent stays where it is
  }
}

// What accepted steps have shown of the true curvature. Reweighted least squares majorises the L1
// loss, so that its curvature is too large, by a factor that differs from direction to direction,
// and its steps too short. BFGS updates of the model's curvature with the last few steps and
// changes of the gradient mend that.
template <int numbers>
class CurvatureCorrection {
 public:
  using Vector = Numbers<numbers>;
  void add(const Vector& step, const Vector& gradient_change) {
    steps_[count_ % capacity] = step;
    changes_[count_ % capacity] = gradient_change;
    ++count_;
  }
  void apply(Eigen::Matrix<double, numbers, numbers>& curvature) const {
    for (std::size_t i = count_ < capacity ? 0 : count_ - capacity; i < count_; ++i) {
      const Vector& step = steps_[i % capacity];
      const Vector& change = changes_[i % capacity];
      const Vector expected = curvature * step;
      const double model = step.dot(expected), seen = step.dot(change);
      if (!(model > 0) || seen < least_share * model)
        continue;
      curvature += change * change.transpose() / seen - expected * expected.transpose() / model;
    }
  }

 private:
  static constexpr std::size_t capacity = 4;
  static constexpr double least_share = 0.05;
  std::array<Vector, capacity> steps_, changes_;
  std::size_t count_ = 0;
};

// The model without its prior.
void evaluate_at(const DescentTask& task, const Place& at, std::size_t direction_stride,
                 double smoothing, ModelWorkspace& workspace, ModelValue& value) {
  if (task.arcs)
    evaluate_arcs(point_of_frame(task.frame, at.p), task.arcs->view, smoothing,
                  task.arcs->workspace, value);
  else
    evaluate_model({task.frame, at.p, *task.cosines, *task.target, direction_stride, smoothing},
                   workspace, value);
}
void evaluate_at(const DescentTask& task, const Place& at, std::size_t direction_stride,
                 double smoothing, ModelWorkspace& workspace, BentModelValue& value) {
  FoldedModelValue of_columns;
  evaluate_model({task.frame, at.p, *task.cosines, *task.target, direction_stride, smoothing},
                 {column_of(at.p, at.bend), task.fold->u}, workspace, of_columns);
  value = bent(of_columns, at.p, at.bend);
}

// P with its horizon tilted no further than its model allows (LobeModel::most_tilt).
void limit_tilt(const LobeFrame& frame, Eigen::Matrix3d& p) {
  const double tilt = std::hypot(p(2, 0), p(2, 1));
  if (const double most = frame.lobe.model->most_tilt() * std::abs(p(2, 2)); tilt > most)
    p.row(2).head<2>() *= most / tilt;
}
bool pulls_at_limit(const LobeFrame& frame, const Eigen::Matrix3d& p, const Vector9& gradient) {
  constexpr double almost = 1 - 1e-9;
  const double most = frame.lobe.model->most_tilt();
  return std::hypot(p(2, 0), p(2, 1)) >= almost * most * std::abs(p(2, 2)) &&
         gradient[6] * p(2, 0) + gradient[7] * p(2, 1) < 0;
}

// Which numbers a step from here may move: a tilt or a g at its bound only away from it.
std::array<bool, 9> free_numbers(const DescentTask& task, const Place& at,
                                 const ModelValue& value) {
  std::array<bool, 9> free = task.free;
  if (pulls_at_limit(task.frame, at.p, value.gradient))
    free[6] = free[7] = false;
  return free;
}
std::array<bool, 11> free_numbers(const DescentTask& task, const Place& at,
                                  const BentModelValue& value) {
  std::array<bool, 11> free;
  std::copy(task.free.begin(), task.free.end(), free.begin());
  free[9] = task.fold->free[0];
  free[10] = task.fold->free[1] && (at.bend[1] < task.fold->most_g || value.gradient[10] > 0);
  return free;
}

// The place a step leads to, made admissible.
template <int numbers>
Place moved(const DescentTask& task, const Place& from, const Numbers<numbers>& step) {
  Place to{from.p + unflattened(step.template head<9>()), from.bend};
  if constexpr (numbers > 9) {
    to.bend += step.template tail<2>();
    to.bend[1] = std::min(to.bend[1], task.fold->most_g);
  }
  // The lobe of M is that of M diag(1, -1, 1), folded the other way: a step through a flat lobe
  // comes out on the other side, and is turned back.
  if (to.p.determinant() < 0) {
    to.p.col(1) = -to.p.col(1);
    to.bend[0] = -to.bend[0];
  }
  limit_tilt(task.frame, to.p);
  to.p /= to.p.col(2).norm();
  return to;
}

template <int numbers>
Descent descend(const DescentTask& task, const DescentOptions& options, ModelWorkspace& workspace,
                std::vector<FitStep>* trace) {
  const LobeFrame& frame = task.frame;
  const double spread = task.spread();
  Descent best;
  Place place{task.start / task.start.col(2).norm(), task.fold ? task.fold->start : Bend::Zero()};
  limit_tilt(frame, place.p);
  ModelValueOf<numbers> value, trial_value;
  evaluate_at(task, place, options.direction_stride, smoothing_share * spread, workspace, value);
  best.loss = value.loss;
  double objective = value.loss + add_prior(frame, spread, place, options.prior_weight, value);
  double damping = options.damping;
  CurvatureCorrection<numbers> correction;
  for (; best.steps < options.steps; ++best.steps) {
    if (options.progress && options.progress->stop_requested())
      break;
    const Place trial = moved<numbers>(
        task, place, damped_step<numbers>(value, free_numbers(task, place, value), damping));
    bool accepted = trial.p.allFinite() && trial.bend.allFinite() && trial.p.determinant() > 0;
    double trial_objective = objective;
    if (accepted) {
      evaluate_at(task, trial, options.direction_stride, smoothing_share * best.loss, workspace,
                  trial_value);
      const double loss = trial_value.loss;
      trial_objective = loss + add_prior(frame, spread, trial, options.prior_weight, trial_value);
      accepted = trial_objective < objective;
    }
    if (trace)
      trace->push_back({accepted ? trial_value.loss : best.loss, value.gradient.norm(), damping,
                        seconds_since(options.begin), accepted, options.phase});
    if (!accepted) {
      damping *= 8;
      if (damping > 1e3) {
        best.converged = true;
        ++best.steps;
        break;
      }
      continue;
    }
    const double gain = objective - trial_objective;
    correction.add(difference<numbers>(trial, place), trial_value.gradient - value.gradient);
    correction.apply(trial_value.curvature);
    place = trial;
    best.loss = trial_value.loss;
    std::swap(value, trial_value);
    objective = trial_objective;
    damping = std::max(damping * 0.25, options.least_damping);
    if (gain < options.tolerance * objective) {
      best.converged = true;
      ++best.steps;
      break;
    }
  }
  lengthen_vanishing_columns(frame, place);
  best.frame_matrix = place.p;
  best.bend = place.bend;
  return best;
}

}  // namespace

double prior(const LobeFrame& frame, double spread, const Eigen::Matrix3d& p, double weight,
             const Bend& bend) {
  double penalty = 0;
  for (int column = 0; column < 2; ++column)
    penalty += 0.5 * prior_strength(frame, spread, column, weight) *
               (p.col(column) - frame.first_order.col(column)).squaredNorm();
  if (!bend.isZero(0))
    penalty += 0.5 * bend_strength(frame, spread, weight).dot(bend.cwiseAbs2());
  return penalty;
}

Descent minimise(const DescentTask& task, const DescentOptions& options, ModelWorkspace& workspace,
                 std::vector<FitStep>* trace) {
  return task.fold ? descend<11>(task, options, workspace, trace)
                   : descend<9>(task, options, workspace, trace);
}

}  // namespace ltc
