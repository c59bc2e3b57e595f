// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The older baseline: Nelder and Mead's simplex (NLopt's) on the L3 error, as Heitz et al. 2016
// fitted isotropic lobes. It has no gradient to lose, but it does lose its way where start and lobe
// do not overlap or the lobe's peak dwarfs all else (Aakash et al. 2022, section 4.1).
#pragma once

#include <vector>

#include "brdf/albedo.h"
#include "fit/l3_error.h"
#include "fit/loss_meter.h"
#include "fit/sample_sets.h"
#include "fit/settings.h"
#include "fit/solver.h"

namespace ltc {

// The simplex search alone, over the entries of P that symmetry leaves free, all of them: scale and
// turn about z move nothing, and a simplex does not mind.
struct SimplexSearch {
  Eigen::Matrix3d frame_matrix;  // the best P seen, determinant >= 0
  double error = 0;              // infinite if no P had a finite one
  int evaluations = 0;
  bool converged = false;  // by the tolerance
};
// `error` is a function of M. The first simplex moves every free entry by a tenth of its column's
// length: a start with a column of zeros, or one that is not finite, has an infinite error. `trace`
// may be null; else it gets every evaluation as a step.
SimplexSearch search_by_simplex(const LobeFrame& frame, const Eigen::Matrix3d& start,
                                const FreeEntries& free, const L3Error& error,
                                const L3Settings& settings, const Progress* progress,
                                std::vector<FitStep>* trace);

// A step is an evaluation of the L3 error, which is what a trace shows as the loss. The result's
// loss is the sliced-Wasserstein loss all the same, on samples of the solver's own, as it is for
// every solver.
class L3NelderMeadSolver final : public Solver {
 public:
  explicit L3NelderMeadSolver(const L3Settings& settings);

  FitResult fit(const FitRequest& request, FitWorkspace& workspace,
                std::vector<FitStep>* trace) const override;

 private:
  L3Settings settings_;
  CosineSet cosines_;
  TargetLattice lattice_;
  AlbedoRule albedo_rule_;
  LossMeter meter_;  // of the result
};

}  // namespace ltc
