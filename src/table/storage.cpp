// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/storage.h"

#include <Eigen/LU>

namespace ltc {

double scale_of(Storage storage, const Eigen::Matrix3d& stored) {
  return storage == Storage::inverse ? stored(1, 1) : stored.col(2).norm();
}

Eigen::Matrix3d matrix_from_stored(Storage storage, const Eigen::Matrix3d& stored,
                                   const Lobe& lobe) {
  if (storage == Storage::matrix)
    return stored;
  if (storage == Storage::inverse)
    return stored.inverse();
  Eigen::Matrix3d matrix = stored;
  matrix.col(0) *= lobe.alpha_x;
  matrix.col(1) *= lobe.alpha_y;
  if (storage == Storage::mirror_frame)
    matrix = (mirror_rotation(lobe.omega_v()) * matrix).eval();
  return matrix;
}

Eigen::Matrix3d stored_from_matrix(Storage storage, const Eigen::Matrix3d& matrix,
                                   const Lobe& lobe) {
  if (storage == Storage::matrix)
    return matrix;
  if (storage == Storage::inverse)
    return matrix.inverse();
  Eigen::Matrix3d stored = matrix;
  if (storage == Storage::mirror_frame)
    stored = (mirror_rotation(lobe.omega_v()).transpose() * stored).eval();
  stored.col(0) /= lobe.alpha_x;
  stored.col(1) /= lobe.alpha_y;
  return stored;
}

}  // namespace ltc
