// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What every solver of the fit has in common: a lobe and a start in, a matrix out.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "brdf/ggx.h"
#include "core/progress.h"
#include "fit/settings.h"
#include "ltc/folded.h"

namespace ltc {

// What a step belongs to.
struct FitPhase {
  enum class Kind {
    given_start,  // the coarse phase, from a start of the request
    own_start,    // the same, from one of the solver's own
    fine,         // from the best of these on; the whole descent of solvers without phases
    fold,         // the coarse phase of a fold, from the LTC that was found or the request's folds
    fine_fold,    // from the best of these on
  };
  Kind kind = Kind::fine;
  int index = 0;  // which of the starts, or of the fine phases
};

// One step of an optimiser, for those who want to watch.
struct FitStep {
  double loss = 0;           // of the sample sets that this step used
  double gradient_norm = 0;  // Frobenius norm, in the solver's own variables
  double damping = 0;        // Levenberg-Marquardt damping, or the step size of a descent
  double seconds = 0;        // since the fit began
  bool accepted = true;
  FitPhase phase = {};
};

enum class FitOutcome {
  converged,   // no gain worth another step; the matrix is the best found
  step_limit,  // the steps were spent; the matrix is the best found
  analytic,    // the closed form is exact to more digits than samples could tell
  non_finite,  // no finite matrix was found; the matrix is NaN
};

struct FitResult {
  Eigen::Matrix3d matrix;  // M, neither aligned nor normalised; determinant > 0
  double loss = 0;         // as the solver saw it, on its own samples
  int steps = 0;           // spent on all starts together
  FitOutcome outcome = FitOutcome::step_limit;
  // The starts of the request led nowhere as good as the solver's own, which this is the end of.
  bool start_abandoned = false;
  Fold fold = {};  // before M, of a solver of folded lobes
};

// A folded lobe to start from.
struct FoldedStart {
  Eigen::Matrix3d matrix;
  Fold fold;
};

struct FitRequest {
  Lobe lobe;
  // Seeds whatever is random about the fit of this lobe.
  std::uint64_t seed = 0;
  // Matrices to start from; empty for the solver's own starting points.
  std::vector<Eigen::Matrix3d> starts;
  // A solution that is known already (Gauss-Newton only). Where no start promises better, it is
  // given back as it came with no more work than that takes to see. Of folded lobes, it stands in
  // place of the LTC: no other is looked for.
  std::optional<FitResult> incumbent;
  // Where not null and a stop is asked for, the fit ends early with whatever it has.
  const Progress* progress = nullptr;
  // Folded lobes to start from beside what follows from the LTC (by solvers of folded lobes); what
  // has no lobe, or a determinant that is not positive, is left out.
  std::vector<FoldedStart> folded_starts = {};
  // A matrix close to the solution, as interpolated between others (plain Gauss-Newton only): it is
  // descended from alone, on fine samples from the first; but of extreme lobes, whose minima are
  // many, it is left out.
  std::optional<Eigen::Matrix3d> near = std::nullopt;
};

// The buffers of one fit at a time; one a thread, reused so that no fit allocates.
struct FitWorkspace;
struct FitWorkspaceDeleter {
  void operator()(FitWorkspace* workspace) const;
};
using FitWorkspacePointer = std::unique_ptr<FitWorkspace, FitWorkspaceDeleter>;
FitWorkspacePointer make_fit_workspace();

// Immutable once made and shared by all threads. `fit` is a function of the request alone: the same
// bits whatever was fitted before in the workspace.
class Solver {
 public:
  virtual ~Solver() = default;
  // `trace`, where not null, gets a record of every step.
  virtual FitResult fit(const FitRequest& request, FitWorkspace& workspace,
                        std::vector<FitStep>* trace) const = 0;
};

// The settings are within their ranges (the config sees to that).
std::unique_ptr<Solver> make_solver(const FitSettings& settings);

}  // namespace ltc
