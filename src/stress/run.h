// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Fits lobes from every start with one solver, and judges all results alike.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/run_context.h"
#include "fit/settings.h"
#include "fit/solver.h"
#include "judge/compare.h"
#include "stress/lobes.h"
#include "stress/starts.h"

namespace ltc {

struct StressTask {
  FitSettings fit;
  // What `fit` is measured against beside its own fits: the best of the two at each lobe. Folded
  // fits are measured against it alone: of several folds that are all better than the LTC, which
  // one a start leads to is no failure.
  FitSettings reference;
  std::vector<StressLobe> lobes;
  CompareSettings judge;  // the judge of all, see graded_judge.h
};

struct StressFit {
  std::size_t lobe = 0;   // index into the task's
  std::size_t start = 0;  // index into stress_starts()
  Eigen::Matrix3d matrix;
  double loss = 0;   // the judge's
  double ratio = 0;  // the loss over the least at this lobe; NaN where there is none
  int steps = 0;
  double seconds = 0;
  FitOutcome outcome = FitOutcome::step_limit;
  bool start_abandoned = false;
  Fold fold = {};
  bool one_to_one = true;  // its fold

  bool finite() const;
  bool determinant_positive() const;  // with a fold that is one to one
};

struct StressRun {
  // Of each lobe all starts in the order of stress_starts(), lobe after lobe.
  std::vector<StressFit> fits;
  std::vector<double> best_loss;  // one a lobe: of all starts and of the reference's own
  std::vector<double> spread;     // of the lobes, GradedJudge::spread
  double seconds = 0;             // of the whole run
};

// The seed of every fit of a run; `ltcfit fit` has the same.
std::uint64_t stress_seed(const FitSettings& fit);

// The same bits with any number of threads but for the times. Throws Interrupted when a stop
// is asked for.
StressRun run_stress(const StressTask& task, const RunContext& context);

// `ratio` of all fits of a lobe, whose losses are known: over the least of them that a finite
// matrix with determinant > 0 has, `reference_loss` (which may be NaN) included; or over the latter
// alone, which it returns then. Losses below the judge's noise count as much as the noise. Returns
// the least loss.
double set_ratios(std::vector<StressFit>& fits, double reference_loss, double noise,
                  bool reference_alone = false);

}  // namespace ltc
