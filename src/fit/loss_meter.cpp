// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/loss_meter.h"

#include "fit/fold_starts.h"

namespace ltc {

LossMeter::LossMeter(std::size_t bins, const Creases& creases)
    : LossMeter(bins, 2048, 32, creases) {}

LossMeter::LossMeter(std::size_t bins, std::size_t samples, std::size_t directions,
                     const Creases& creases)
    : bins_(bins),
      cosines_(make_cosine_set(samples)),
      lattice_(make_target_lattice(2 * samples, 0.3)),
      directions_(in_float(fibonacci_directions(directions))) {
  if (!creases.empty())
    u_ = crease_distances(cosines_, creases);
}

void LossMeter::set_target(const LobeFrame& frame, FitWorkspace& workspace) const {
  sample_weighted_target(frame, lattice_, workspace.target);
}

double LossMeter::loss(const LobeFrame& frame, const Eigen::Matrix3d& frame_matrix,
                       FitWorkspace& workspace) const {
  TargetQuantiles& quantiles = workspace.quantiles;
  quantiles.build(workspace.target, directions_, bins_, workspace.model.xi, workspace.model.bins);
  ModelValue value;
  evaluate_model({frame, frame_matrix, cosines_, quantiles, 1, quantiles.spread()}, workspace.model,
                 value);
  return value.loss;
}

double LossMeter::loss(const LobeFrame& frame, const Eigen::Matrix3d& frame_matrix,
                       const Fold& fold, FitWorkspace& workspace) const {
  TargetQuantiles& quantiles = workspace.quantiles;
  quantiles.build(workspace.target, directions_, bins_, workspace.model.xi, workspace.model.bins);
  FoldedModelValue value;
  evaluate_model({frame, frame_matrix, cosines_, quantiles, 1, quantiles.spread()},
                 {column_of(frame_matrix, bend_of(frame, fold)), u_}, workspace.model, value);
  return value.loss;
}

}  // namespace ltc
