// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/gauss_newton.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>

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
  const double roughness[2] = {frame.lobe.alpha_x, frame.lobe.alpha_y};
  const double width = std::max(roughness[0] * frame.first_order.col(0).norm(),
                                roughness[1] * frame.first_order.col(1).norm());
  const double wide = spread / prior_spread, relative = roughness[column] / width;
  return weight * spread / (1 + wide * wide) * relative * relative;
}

// Adds the prior to the model at P, and returns its own value.
double add_prior(const LobeFrame& frame, double spread, const Eigen::Matrix3d& p, double weight,
                 ModelValue& value) {
  for (int column = 0; column < 2; ++column) {
    const double strength = prior_strength(frame, spread, column, weight);
    for (int row = 0; row < 3; ++row) {
      const int entry = 3 * row + column;
      value.gradient[entry] += strength * (p(row, column) - frame.first_order(row, column));
      value.curvature(entry, entry) += strength;
    }
  }
  return prior(frame, spread, p, weight);
}

// An entry's own curvature counts at least this share of its column's.
constexpr double least_own_curvature = 1e-9;

// The damped step over the free entries. Damping is relative to each entry's own curvature: row 2
// of a thin column has a curvature of the roughness squared of its column's, and would not move if
// damped like that. Scale and rotation, which move nothing, are held by damping alone.
Eigen::Matrix3d damped_step(const ModelValue& value, const FreeEntries& free, double damping) {
  int index[9], count = 0;
  for (int entry = 0; entry < 9; ++entry)
    if (free[entry])
      index[count++] = entry;
  double column_curvature[3] = {};
  for (int entry = 0; entry < 9; ++entry)
    column_curvature[entry % 3] += value.curvature(entry, entry) / 3;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 9> system(count, count);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1> right(count), scale(count);
  for (int i = 0; i < count; ++i)
    scale[i] = 1 / std::sqrt(std::max(value.curvature(index[i], index[i]),
                                      least_own_curvature * column_curvature[index[i] % 3]));
  // Scaled to a unit diagonal, so that columns of very different roughness keep their digits.
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j)
      system(i, j) = value.curvature(index[i], index[j]) * scale[i] * scale[j];
    system(i, i) += damping;
    right[i] = -value.gradient[index[i]] * scale[i];
  }
  const auto solution = system.ldlt().solve(right).eval();
  Eigen::Matrix3d step = Eigen::Matrix3d::Zero();
  for (int i = 0; i < count; ++i)
    step(index[i] / 3, index[i] % 3) = solution[i] * scale[i];
  return step;
}

// A lobe much thinner than it is wide is a line to its samples: they hardly feel the length of the
// thin column, and a step that turns it round may leave it anywhere near zero. A column shorter
// than this share of the first-order lobe's is lengthened where M has a larger condition number
// than this, half of where single precision cannot invert it.
constexpr double short_column_share = 0.005, most_condition = 5e6;

void lengthen_vanishing_columns(const LobeFrame& frame, Eigen::Matrix3d& p) {
  const Eigen::Vector3d roughness(frame.lobe.alpha_x, frame.lobe.alpha_y, 1);
  const Eigen::Vector3d singular =
      Eigen::JacobiSVD<Eigen::Matrix3d>(p * roughness.asDiagonal()).singularValues();
  const double excess = singular[0] / singular[2] / most_condition;
  if (!(excess > 1))
    return;
  for (int column = 0; column < 2; ++column) {
    const double length = p.col(column).norm();
    const double least = short_column_share * frame.first_order.col(column).norm();
    if (length > 0 && length < least)
      p.col(column) *= std::min(excess, least / length);
  }
}

// What accepted steps have shown of the true curvature. Reweighted least squares majorises the L1
// loss, so that its curvature is too large, by a factor that differs from direction to direction,
// and its steps too short. BFGS updates of the model's curvature with the last few steps and
// changes of the gradient mend that.
class CurvatureCorrection {
 public:
  void add(const Vector9& step, const Vector9& gradient_change) {
    steps_[count_ % capacity] = step;
    changes_[count_ % capacity] = gradient_change;
    ++count_;
  }
  void apply(Matrix9& curvature) const {
    for (std::size_t i = count_ < capacity ? 0 : count_ - capacity; i < count_; ++i) {
      const Vector9& step = steps_[i % capacity];
      const Vector9& change = changes_[i % capacity];
      const Vector9 expected = curvature * step;
      const double model = step.dot(expected), seen = step.dot(change);
      if (!(model > 0) || seen < least_share * model)
        continue;
      curvature += change * change.transpose() / seen - expected * expected.transpose() / model;
    }
  }

 private:
  static constexpr std::size_t capacity = 4;
  static constexpr double least_share = 0.05;
  std::array<Vector9, capacity> steps_, changes_;
  std::size_t count_ = 0;
};

}  // namespace

double prior(const LobeFrame& frame, double spread, const Eigen::Matrix3d& p, double weight) {
  double penalty = 0;
  for (int column = 0; column < 2; ++column)
    penalty += 0.5 * prior_strength(frame, spread, column, weight) *
               (p.col(column) - frame.first_order.col(column)).squaredNorm();
  return penalty;
}

Descent minimise(const DescentTask& task, const DescentOptions& options, ModelWorkspace& workspace,
                 std::vector<FitStep>* trace) {
  const auto& [frame, start, free, cosines, target] = task;
  Descent best;
  best.frame_matrix = start / start.col(2).norm();
  ModelValue value, trial_value;
  double smoothing = smoothing_share * target.spread();
  evaluate_model({frame, best.frame_matrix, cosines, target, options.direction_stride, smoothing},
                 workspace, value);
  best.loss = value.loss;
  double objective = value.loss + add_prior(frame, target.spread(), best.frame_matrix,
                                            options.prior_weight, value);
  double damping = options.damping;
  CurvatureCorrection correction;
  for (; best.steps < options.steps; ++best.steps) {
    if (options.progress && options.progress->stop_requested())
      break;
    Eigen::Matrix3d trial = best.frame_matrix + damped_step(value, free, damping);
    // The lobe of M is that of M diag(1, -1, 1): a step through a flat lobe comes out on the other
    // side, and is turned back.
    if (trial.determinant() < 0)
      trial.col(1) = -trial.col(1);
    trial /= trial.col(2).norm();
    smoothing = smoothing_share * best.loss;
    bool accepted = trial.allFinite() && trial.determinant() > 0;
    double trial_objective = objective;
    if (accepted) {
      evaluate_model({frame, trial, cosines, target, options.direction_stride, smoothing},
                     workspace, trial_value);
      const double loss = trial_value.loss;
      trial_objective =
          loss + add_prior(frame, target.spread(), trial, options.prior_weight, trial_value);
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
    correction.add(flattened(trial - best.frame_matrix), trial_value.gradient - value.gradient);
    correction.apply(trial_value.curvature);
    best.frame_matrix = trial;
    best.loss = trial_value.loss;
    std::swap(value, trial_value);
    objective = trial_objective;
    damping = std::max(damping * 0.25, 1e-5);
    if (gain < options.tolerance * objective) {
      best.converged = true;
      ++best.steps;
      break;
    }
  }
  lengthen_vanishing_columns(frame, best.frame_matrix);
  return best;
}

}  // namespace ltc
