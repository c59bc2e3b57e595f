// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Compares a gradient by hand with central differences.
//
// With the step h and E the unit matrix of an entry, (L(M + hE) - L(M - hE)) / 2h differs from the
// entry's derivative by h^2 L'''/6 and by the rounding of L over h. Neither means anything where a
// kink of the loss lies between the two: there the loss says so (see LossAndGradient::piece), the
// step is made smaller, and what still has a kink in the smallest step is left undecided.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "fit/sliced_wasserstein.h"

namespace ltc {

struct GradientCheckOptions {
  // First h, as a share of the Frobenius norm of M, (0, 1); larger ones see more kinks and lose
  // digits to L''', smaller ones to rounding.
  double relative_step = 1e-6;
  // How often an entry with a kink is tried again with a tenth of the step, [0, 10]. Narrow lobes
  // need it: their kinks lie as close together as they are narrow.
  int retries = 6;
  // Largest error of an entry that passes, as a share of the largest |entry| of the gradient in its
  // column, (0, 1).
  double tolerance = 1e-6;
};

struct GradientCheck {
  Eigen::Matrix3d numeric;            // central differences; NaN where undecided
  std::array<bool, 9> undecided{};    // row-major: a tie or kink lies within the smallest step
  double largest_relative_error = 0;  // of the decided entries; NaN if a gradient is not finite
  int worst_row = 0, worst_column = 0;
  bool passed = false;  // every entry decided and within the tolerance

  int undecided_count() const;
  // One line for people: the verdict, the worst entry, what is undecided.
  std::string describe() const;
};

// Checks `gradient` as dL/dM of `loss` at `matrix`.
GradientCheck check_gradient(const SlicedWassersteinLoss& loss, const Eigen::Matrix3d& matrix,
                             const Eigen::Matrix3d& gradient,
                             const GradientCheckOptions& options = {});

}  // namespace ltc
