// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Where fits of folded lobes start from, and the quadrant that they are made in.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/gauss_newton.h"
#include "fit/solver.h"

namespace ltc {

// What of a fold symmetry leaves free, k and g: in the plane of alpha_x nothing bends to a side.
std::array<bool, 2> free_fold(const Lobe& lobe);

// The bend of a fold in a lobe's frame, and back.
Bend bend_of(const LobeFrame& frame, const Fold& fold);
Fold fold_of(const LobeFrame& frame, const Bend& bend);

// Places to descend from, P and bend: those of the solution at hand and, where it has no fold, for
// then neither sign is better than the other, bent either way; then those of `given` that are one
// to one and have a determinant > 0, entries that are not free set to zero. `frame` is of a lobe in
// the first quadrant.
std::vector<Descent> fold_starts(const LobeFrame& frame, const FitResult& at_hand,
                                 const std::vector<FoldedStart>& given, const Creases& creases);

// Creases lie along the larger roughness: a lobe with alpha_y > alpha_x or of another quadrant is
// the image of one in the first (table/reduction.h), which a matrix on the left of M leads back to.
class QuadrantImage {
 public:
  explicit QuadrantImage(const FitRequest& request);

  // The request for the lobe in the first quadrant, and its result as one of the lobe asked for.
  // Determinants stay positive: M fold(omega_o) is distributed as M diag(1, -1, 1) with -k.
  const FitRequest& request() const { return request_; }
  FitResult unfolded(FitResult result) const;

 private:
  Eigen::Matrix3d unfold_ = Eigen::Matrix3d::Identity();
  FitRequest request_;
};

}  // namespace ltc
