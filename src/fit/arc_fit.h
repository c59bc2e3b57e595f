// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The Gauss-Newton fit of a lobe by arcs (arc_model.h): from its moment start with few directions
// and thresholds, then with as many as the settings say.
//
// For lobes that are neither very sharp nor very thin: of sharp ones, what an LTC misses is less
// than the noise of the samples that the lobe's distribution is counted on, and thin ones have
// several minima, which the quantiles of samples tell apart better.
#pragma once

#include <chrono>
#include <vector>

#include "fit/arc_model.h"
#include "fit/gauss_newton.h"
#include "fit/settings.h"
#include "fit/solver.h"
#include "fit/workspace.h"

namespace ltc {

class ArcFit {
 public:
  explicit ArcFit(const GaussNewtonSettings& settings);

  static bool takes(const LobeFrame& frame);

  // NaN where no finite matrix is found. `trace` may be null.
  FitResult fit(const FitRequest& request, const LobeFrame& frame, FitWorkspace& workspace,
                std::vector<FitStep>* trace) const;

 private:
  // What the lobe is counted on, along which directions, and how to descend.
  struct Level {
    TargetLattice lattice;
    ArcDirections directions;
    ArcRule rule;
    DescentOptions options;
  };
  struct Request {
    const FitRequest& fit;
    const LobeFrame& frame;
    FreeEntries free;
    std::chrono::steady_clock::time_point begin;
    FitWorkspace& workspace;
    std::vector<FitStep>* trace;
  };
  Descent descend(const Level& level, const Request& request, const Eigen::Matrix3d& start,
                  FitPhase phase) const;

  Level coarse_, fine_;
};

}  // namespace ltc
