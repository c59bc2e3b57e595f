// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/matrix_invariants.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <limits>

#include "align/align.h"
#include "core/angle.h"

namespace ltc {

double condition_number(const Eigen::Matrix3d& matrix) {
  if (!matrix.allFinite())
    return std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d singular_values =
      Eigen::JacobiSVD<Eigen::Matrix3d>(matrix).singularValues();
  return singular_values.z() > 0 ? singular_values.x() / singular_values.z()
                                 : std::numeric_limits<double>::infinity();
}

double misalignment_degrees(const Eigen::Matrix3d& matrix) {
  if (matrix.determinant() < 0)
    return 180;
  const Eigen::Matrix3d turn = matrix.partialPivLu().solve(align(matrix));
  return std::abs(std::atan2(turn(1, 0), turn(0, 0))) / radians_per_degree;
}

}  // namespace ltc
