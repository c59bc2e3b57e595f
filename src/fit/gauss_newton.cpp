// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/gauss_newton.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>

namespace ltc {
namespace {

// Squared distance of columns 0 and 1 of P from P0's counts this much: enough to decide what the
// samples of a sharp lobe leave open (its tails), far too little to matter where they speak.
constexpr double prior_weight = 1e-6;

// Smoothing e of the reweighting, as a share of the loss: below it a residual counts as zero.
constexpr double smoothing_share = 0.05;

// Reweighted least squares majorises the L1 loss: its steps are too short by about this factor.
constexpr double over_relaxation = 1.3;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Adds the prior to the model at P, and returns its own value.
double add_prior(const LobeFrame& frame, const Eigen::Matrix3d& p, ModelValue& value) {
  double penalty = 0;
  const double largest = std::max(frame.lobe.alpha_x, frame.lobe.alpha_y);
  const double share[2] = {frame.lobe.alpha_x / largest, frame.lobe.alpha_y / largest};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 2; ++column) {
      const double difference = p(row, column) - frame.first_order(row, column);
      const double weight = prior_weight * share[column] * share[column];
      penalty += 0.5 * weight * difference * difference;
      value.gradient[3 * row + column] += weight * difference;
      value.curvature(3 * row + column, 3 * row + column) += weight;
    }
  }
  return penalty;
}

// The damped step over the free entries. Damping is relative to each column's mean curvature, since
// a column moves the lobe by its own roughness; scale and rotation, which move nothing, are held by
// it alone.
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
    scale[i] = 1 / std::sqrt(column_curvature[index[i] % 3]);
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

}  // namespace

Descent minimise(const LobeFrame& frame, const Eigen::Matrix3d& start, const FreeEntries& free,
                 const CosineSet& cosines, const TargetQuantiles& target,
                 const DescentOptions& options, ModelWorkspace& workspace,
                 std::vector<FitStep>* trace) {
  Descent best;
  best.frame_matrix = start / start.col(2).norm();
  ModelValue value, trial_value;
  double smoothing = smoothing_share * target.spread();
  evaluate_model(frame, best.frame_matrix, cosines, target, smoothing, workspace, value);
  best.loss = value.loss;
  double objective = value.loss + add_prior(frame, best.frame_matrix, value);
  double damping = options.damping;
  const auto begin = std::chrono::steady_clock::now();
  for (; best.steps < options.steps; ++best.steps) {
    Eigen::Matrix3d trial = best.frame_matrix + over_relaxation * damped_step(value, free, damping);
    // The lobe of M is that of M diag(1, -1, 1): a step through a flat lobe comes out on the other
    // side, and is turned back.
    if (trial.determinant() < 0)
      trial.col(1) = -trial.col(1);
    trial /= trial.col(2).norm();
    smoothing = smoothing_share * best.loss;
    bool accepted = trial.allFinite() && trial.determinant() > 0;
    double trial_objective = objective;
    if (accepted) {
      evaluate_model(frame, trial, cosines, target, smoothing, workspace, trial_value);
      const double loss = trial_value.loss;
      trial_objective = loss + add_prior(frame, trial, trial_value);
      accepted = trial_objective < objective;
    }
    if (trace)
      trace->push_back({accepted ? trial_value.loss : best.loss, value.gradient.norm(), damping,
                        seconds_since(begin), accepted, options.phase});
    if (!accepted) {
      damping *= 8;
      if (damping > 1e3) {
        best.converged = true;
        break;
      }
      continue;
    }
    const double gain = objective - trial_objective;
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
  return best;
}

}  // namespace ltc
