// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The sliced-Wasserstein loss of a matrix by bins, on a set of samples of its own: what a table
// stores of a matrix that its solver has not measured itself.
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
  // 2048 cosine samples, 4096 of the lobe, 32 directions.
  explicit LossMeter(std::size_t bins, const Creases& creases = {});
  // So many cosine samples, twice as many of the lobe.
  LossMeter(std::size_t bins, std::size_t samples, std::size_t directions,
            const Creases& creases = {});

  // The workspace's target of a lobe, to be set before loss().
  void set_target(const LobeFrame& frame, FitWorkspace& workspace) const;

  // Of the LTC of a frame matrix P (lobe_frame.h).
  double loss(const LobeFrame& frame, const Eigen::Matrix3d& frame_matrix,
              FitWorkspace& workspace) const;
  // The same folded along the meter's creases, at least one.
  double loss(const LobeFrame& frame, const Eigen::Matrix3d& frame_matrix, const Fold& fold,
              FitWorkspace& workspace) const;

 private:
  std::size_t bins_;
  CosineSet cosines_;
  AlignedFloats u_;  // of the cosines
  TargetLattice lattice_;
  std::vector<Eigen::Vector3f> directions_;
};

}  // namespace ltc
