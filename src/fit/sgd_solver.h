// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Algorithm 3 of Aakash et al. 2022: stochastic gradient descent on the sliced-Wasserstein loss.
#pragma once

#include <vector>

#include "fit/sample_sets.h"
#include "fit/settings.h"
#include "fit/solver.h"

namespace ltc {

// Fresh random cosine samples and directions every step, a buffer of target samples refreshed by
// rejection (or redrawn by weight), and the gradient by hand: with sorted projections x_(i) against
// target quantiles q_i, mean_k mean_i sign(x_(i) - q_i) dx_(i)/dM.
class SgdSolver final : public Solver {
 public:
  SgdSolver(const SgdSettings& settings, TargetKind target);

  FitResult fit(const FitRequest& request, FitWorkspace& workspace,
                std::vector<FitStep>* trace) const override;

 private:
  SgdSettings settings_;
  TargetKind target_kind_;
  TargetLattice lattice_;
};

}  // namespace ltc
