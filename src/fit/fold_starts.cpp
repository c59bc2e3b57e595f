// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/fold_starts.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "field/field.h"
#include "fit/starting_points.h"
#include "table/reduction.h"
#include "table/symmetry.h"

namespace ltc {
namespace {

// Of the first bend, times (1 - lambda) sin theta sin phi: a lobe's kappa is between -0.2 and -1.7.
constexpr double first_kappa = 0.8;

bool is_in_first_quadrant(const Lobe& lobe) {
  return lobe.alpha_x >= lobe.alpha_y && lobe.phi_radians >= 0 &&
         lobe.phi_radians <= std::numbers::pi / 2;
}

void mirror(Eigen::Matrix3d& matrix, Fold& fold, const Eigen::Matrix3d& by) {
  matrix = by * matrix;
  if (by.determinant() < 0) {
    matrix.col(1) = -matrix.col(1);
    fold.k = -fold.k;
  }
}

}  // namespace

std::array<bool, 2> free_fold(const Lobe& lobe) {
  return {!looks_along_x(lobe.theta_radians, lobe.phi_radians), true};
}

Bend bend_of(const LobeFrame& frame, const Fold& fold) {
  return {frame.lobe.alpha_y * fold.k, fold.g};
}
Fold fold_of(const LobeFrame& frame, const Bend& bend) {
  return {bend[0] / frame.lobe.alpha_y, bend[1]};
}

std::vector<Descent> fold_starts(const LobeFrame& frame, const FitResult& at_hand,
                                 const std::vector<FoldedStart>& given, const Creases& creases) {
  const Lobe& lobe = frame.lobe;
  const bool bends = free_fold(lobe)[0];
  std::vector<Descent> starts = {{frame.from_matrix(at_hand.matrix), bend_of(frame, at_hand.fold)}};
  if (bends && at_hand.fold == Fold{}) {
    const FieldVariables at(lobe, 0);
    const double kappa = first_kappa * (1 - at.lambda) * at.sin_theta * std::sin(lobe.phi_radians);
    for (const double sign : {-1.0, 1.0})
      starts.push_back(
          {starts.front().frame_matrix, bend_of(frame, fold_of(sign * kappa, 0, lobe, creases))});
  }
  for (const FoldedStart& start : given) {
    const Eigen::Matrix3d p = admissible(frame.from_matrix(start.matrix), free_entries(lobe));
    if (p.allFinite() && start.matrix.determinant() > 0 && p.determinant() > 0 &&
        is_one_to_one(start.fold, creases))
      starts.push_back({p, bend_of(frame, {bends ? start.fold.k : 0,
                                           std::min(start.fold.g, most_fold(creases))})});
  }
  return starts;
}

QuadrantImage::QuadrantImage(const FitRequest& request) : request_(request) {
  if (is_in_first_quadrant(request.lobe))
    return;
  const FoldedLobe image = ltc::fold(request.lobe);
  unfold_ = image.unfold;
  request_.lobe = image.lobe;
  const Eigen::Matrix3d back = unfold_.transpose();
  for (Eigen::Matrix3d& start : request_.starts)
    start = back * start * unfold_;
  for (FoldedStart& start : request_.folded_starts)
    mirror(start.matrix, start.fold, back);
  if (request_.incumbent)
    mirror(request_.incumbent->matrix, request_.incumbent->fold, back);
}

FitResult QuadrantImage::unfolded(FitResult result) const {
  mirror(result.matrix, result.fold, unfold_);
  return result;
}

}  // namespace ltc
