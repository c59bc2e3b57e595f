// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/loss_meter.h"

#include "fit/fold_starts.h"
#include "fit/lobe_class.h"

namespace ltc {
namespace {

constexpr std::size_t samples_of_sharp = 4096, samples_of_others = 2048;
constexpr std::size_t direction_count = 16, thresholds = 16, arc_nodes = 8;
// Of folded lobes.
constexpr std::size_t cosine_samples = 2048, directions_of_bins = 32, bins = 64;

}  // namespace

LossMeter::LossMeter(const Creases& creases)
    : lattice_of_sharp_(make_target_lattice(samples_of_sharp, 0.3)),
      lattice_(make_target_lattice(samples_of_others, 0.3)),
      directions_(in_float(fibonacci_directions(direction_count))),
      rule_(thresholds, arc_nodes, ArcRule::Reach::far) {
  if (creases.empty())
    return;
  directions_of_bins_ = in_float(fibonacci_directions(directions_of_bins));
  cosines_ = make_cosine_set(cosine_samples);
  u_ = crease_distances(cosines_, creases);
}

void LossMeter::set_target(const LobeFrame& frame, FitWorkspace& workspace) const {
  const bool folded = !directions_of_bins_.empty();
  sample_weighted_target(frame, folded || is_sharp(frame) ? lattice_of_sharp_ : lattice_,
                         workspace.target);
  if (!folded)
    ltc::set_target(workspace.target, directions_, rule_, workspace.model.xi, workspace.arc_target);
}

double LossMeter::loss(const LobeFrame& frame, const Eigen::Matrix3d& frame_matrix,
                       FitWorkspace& workspace) const {
  return arc_loss(point_of_frame(frame, frame_matrix), {directions_, rule_, workspace.arc_target},
                  workspace.arcs);
}

double LossMeter::loss(const LobeFrame& frame, const Eigen::Matrix3d& frame_matrix,
                       const Fold& fold, FitWorkspace& workspace) const {
  TargetQuantiles& quantiles = workspace.quantiles;
  quantiles.build(workspace.target, directions_of_bins_, bins, workspace.model.xi,
                  workspace.model.bins);
  FoldedModelValue value;
  evaluate_model({frame, frame_matrix, cosines_, quantiles, 1, quantiles.spread()},
                 {column_of(frame_matrix, bend_of(frame, fold)), u_}, workspace.model, value);
  return value.loss;
}

}  // namespace ltc
