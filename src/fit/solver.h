// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What every solver of the fit has in common: a lobe and a start in, a matrix out.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <vector>

#include "brdf/ggx.h"

namespace ltc {

// One step of an optimiser, for those who want to watch.
struct FitStep {
  double loss = 0;           // of the sample sets that this step used
  double gradient_norm = 0;  // Frobenius norm, in the solver's own variables
  double damping = 0;        // Levenberg-Marquardt damping, or the step size of a descent
  double seconds = 0;        // since the fit began
  bool accepted = true;
};

enum class FitOutcome {
  converged,       // no further gain above the sampling noise; the matrix is the best found
  step_limit,      // the steps were spent; the matrix is the best found
  non_finite,      // no finite matrix was found; the matrix is NaN
};

struct FitResult {
  Eigen::Matrix3d matrix;  // M, neither aligned nor normalised; determinant > 0
  double loss = 0;         // as the solver saw it, on its own samples
  int steps = 0;
  FitOutcome outcome = FitOutcome::step_limit;
};

}  // namespace ltc
