// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/storage.h"

#include <Eigen/LU>

#include "field/field.h"

namespace ltc {

double scale_of(Storage storage, const Eigen::Matrix3d& stored) {
  return storage == Storage::inverse ? stored(1, 1) : stored.col(2).norm();
}

Eigen::Vector3d scale_of_columns(Storage storage, const Lobe& lobe) {
  switch (storage) {
    case Storage::matrix:
    case Storage::inverse:
      return Eigen::Vector3d::Ones();
    case Storage::folded:
      return {lobe.alpha_x, width_across(lobe), 1};
    default:
      return {lobe.alpha_x, lobe.alpha_y, 1};
  }
}

Eigen::Matrix3d matrix_from_stored(Storage storage, const Eigen::Matrix3d& stored,
                                   const Lobe& lobe) {
  if (storage == Storage::matrix)
    return stored;
  if (storage == Storage::inverse)
    return stored.inverse();
  const Eigen::Vector3d scale = scale_of_columns(storage, lobe);
  Eigen::Matrix3d matrix = stored;
  matrix.col(0) *= scale.x();
  matrix.col(1) *= scale.y();
  if (is_in_mirror_frame(storage))
    matrix = (mirror_rotation(lobe.omega_v()) * matrix).eval();
  return matrix;
}

Eigen::Matrix3d stored_from_matrix(Storage storage, const Eigen::Matrix3d& matrix,
                                   const Lobe& lobe) {
  if (storage == Storage::matrix)
    return matrix;
  if (storage == Storage::inverse)
    return matrix.inverse();
  const Eigen::Vector3d scale = scale_of_columns(storage, lobe);
  Eigen::Matrix3d stored = matrix;
  if (is_in_mirror_frame(storage))
    stored = (mirror_rotation(lobe.omega_v()).transpose() * stored).eval();
  stored.col(0) /= scale.x();
  stored.col(1) /= scale.y();
  return stored;
}

}  // namespace ltc
