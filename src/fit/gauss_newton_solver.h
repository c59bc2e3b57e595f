// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The default solver: quantile Gauss-Newton from several starts on a coarse sample set, then from
// the best of them on a fine one.
//
// Given starts may be anything. Their scale, the sign of their determinant and the hemisphere they
// look into are put right; one that has no lobe at all, or whose coarse descent ends worse than
// that of the solver's own starts, is abandoned for these (FitResult::start_abandoned).
//
// With creases, the LTC is folded then, or the request's incumbent: from the places of
// fold_starts.h, by the same phases. Where no fold has less loss on the finest samples, the result
// is what there was. Symmetry: in the plane of alpha_x nothing bends to a side (k = 0 at phi = 0
// and theta = 0), in that of alpha_y the fold is symmetric as it is, and isotropic lobes are not
// folded, as all azimuths share theirs.
#pragma once

#include <optional>
#include <vector>

#include "fit/arc_fit.h"
#include "fit/sample_ladder.h"
#include "fit/settings.h"
#include "fit/solver.h"

namespace ltc {

class GaussNewtonSolver final : public Solver {
 public:
  GaussNewtonSolver(const GaussNewtonSettings& settings, TargetKind target,
                    const Creases& creases = {}, HorizonMode horizon = HorizonMode::clipped);

  FitResult fit(const FitRequest& request, FitWorkspace& workspace,
                std::vector<FitStep>* trace) const override;

 private:
  const SampleLadder& ladder_for(const LobeFrame& frame) const;

  // Draws the target from one of the lobe's lattices and looks at it along all directions.
  enum class Look { light, whole };
  void see_target(const LobeFrame& frame, std::uint64_t seed, Look look,
                  FitWorkspace& workspace) const;
  // At least as many as the settings say.
  std::vector<Eigen::Matrix3d> own_starts(const LobeFrame& frame, std::uint64_t seed,
                                          const FitWorkspace& workspace) const;

  GaussNewtonSettings settings_;
  TargetKind target_kind_;
  Creases creases_;
  std::vector<Eigen::Vector3f> directions_;
  std::size_t bins_;
  SampleLadder usual_, graded_;
  std::optional<ArcFit> arcs_;  // where lobes may be fitted by arcs

  class Fit;
};

}  // namespace ltc
