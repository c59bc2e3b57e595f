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
  // A cosine set, shared by all entries, and how to descend with it.
  struct Level {
    CosineSet cosines;
    DescentOptions options;
  };
  static Level make_level(int samples, int steps, double tolerance, double shift);

  // Draws the target from one of the lattices and looks at it along all directions.
  void see_target(const LobeFrame& frame, std::uint64_t seed, const TargetLattice& lattice,
                  FitWorkspace& workspace) const;
  std::vector<Eigen::Matrix3d> own_starts(const LobeFrame& frame, std::uint64_t seed,
                                          const FitWorkspace& workspace) const;
  // The first level that has samples enough for a lobe whose loss is this share of its spread.
  std::size_t level_for(double relative_loss) const;
  Descent climb(const LobeFrame& frame, const FitRequest& request, Descent descent,
                DescentOptions watched, FitWorkspace& workspace, FitResult& result,
                std::vector<FitStep>* trace) const;
  double coarse_loss(const LobeFrame& frame, const Eigen::Matrix3d& start,
                     FitWorkspace& workspace) const;
  // From every start whose loss is not hopeless beside the least.
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
  std::vector<Eigen::Vector3f> directions_;
  std::size_t bins_;
  TargetLattice lattice_, light_lattice_;  // of the last level, and of all below
  Level coarse_;
  std::vector<Level> levels_;  // ascending
};

}  // namespace ltc
