// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The default solver: quantile Gauss-Newton from several starts on a coarse sample set, then from
// the best of them on a fine one.
#pragma once

#include <vector>

#include "fit/gauss_newton.h"
#include "fit/sample_sets.h"
#include "fit/settings.h"
#include "fit/solver.h"

namespace ltc {

class GaussNewtonSolver final : public Solver {
 public:
  GaussNewtonSolver(const GaussNewtonSettings& settings, TargetKind target);

  FitResult fit(const FitRequest& request, FitWorkspace& workspace,
                std::vector<FitStep>* trace) const override;

 private:
  // One phase's fixed sets, shared by all entries.
  struct Phase {
    CosineSet cosines;
    std::vector<Eigen::Vector3f> directions;
    std::size_t bins;
    DescentOptions options;
  };
  static Phase make_phase(int samples, int directions, int steps, double shift);

  void sample_target(const LobeFrame& frame, std::uint64_t seed, FitWorkspace& workspace) const;
  std::vector<Eigen::Matrix3d> own_starts(const LobeFrame& frame, std::uint64_t seed,
                                          const FitWorkspace& workspace) const;

  Descent best_coarse_descent(const LobeFrame& frame, const std::vector<Eigen::Matrix3d>& starts,
                              DescentOptions options, FitWorkspace& workspace, FitResult& result,
                              std::vector<FitStep>* trace) const;
  FitResult analytic_result(const LobeFrame& frame, FitWorkspace& workspace) const;
  // The start of least loss, where that is not hopeless beside `loss_to_beat`; none otherwise.
  std::vector<Eigen::Matrix3d> promising(const LobeFrame& frame,
                                         const std::vector<Eigen::Matrix3d>& starts,
                                         double loss_to_beat, FitWorkspace& workspace) const;

  GaussNewtonSettings settings_;
  TargetKind target_kind_;
  TargetLattice lattice_;
  Phase coarse_, fine_;
};

}  // namespace ltc
