// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The sliced-Wasserstein loss of a matrix, on samples of the lobe that no fit has seen: what a
// table stores of a matrix that its solver has not measured itself. By arcs (fit/arc_model.h); of
// folded lobes by bins, on samples of the LTC too. Off by 4 % of the loss, in the mean square over
// lobes of all kinds (of sharp ones that an LTC comes near, up to 20).
//
// Judges sort instead, which is exact and slower: judge/held_out.h in single precision, for lobes
// of a table; stress/graded_judge.h in double, with graded samples, for lobes far sharper.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/workspace.h"
#include "ltc/folded.h"

namespace ltc {

class LossMeter {
 public:
  explicit LossMeter(const Creases& creases = {});

  // The workspace's target of a lobe, to be set before loss().
  void set_target(const LobeFrame& frame, FitWorkspace& workspace) const;

  // Of the LTC of a frame matrix P (lobe_frame.h).
  double loss(const LobeFrame& frame, const Eigen::Matrix3d& frame_matrix,
              FitWorkspace& workspace) const;
  // The same folded along the meter's creases, at least one.
  double loss(const LobeFrame& frame, const Eigen::Matrix3d& frame_matrix, const Fold& fold,
              FitWorkspace& workspace) const;

 private:
  TargetLattice lattice_of_sharp_, lattice_;
  ArcDirections directions_;
  ArcRule rule_;
  // Of folded lobes.
  std::vector<Eigen::Vector3f> directions_of_bins_;
  CosineSet cosines_;
  AlignedFloats u_;
};

}  // namespace ltc
