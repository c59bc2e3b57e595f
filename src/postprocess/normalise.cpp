// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Normalising and rounding a matrix for storage.
#include "postprocess/normalise.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace ltc {
namespace {

constexpr int kMostSteps =
    8;  // units in the last place: 8 x 6e-8 leaves the 1e-6 of the third column

Eigen::Matrix3d round_to_float(const Eigen::Matrix3d& matrix) {
  return matrix.cast<float>().cast<double>();
}

// Moves every non-zero entry by `steps` floats in the direction in which the determinant grows,
// which the signs of the cofactors say.
Eigen::Matrix3d towards_larger_determinant(const Eigen::Matrix3d& matrix, int steps) {
  Eigen::Matrix3d cofactors;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      cofactors(i, j) = matrix(i1, j1) * matrix(i2, j2) - matrix(i1, j2) * matrix(i2, j1);
    }
  Eigen::Matrix3f moved = matrix.cast<float>();
  for (int i = 0; i < 9; ++i) {
    if (moved(i) == 0 || cofactors(i) == 0)
      continue;
    const float target =
        std::copysign(std::numeric_limits<float>::infinity(), static_cast<float>(cofactors(i)));
    for (int step = 0; step < steps; ++step)
      moved(i) = std::nextafter(moved(i), target);
  }
  return moved.cast<double>();
}

}  // namespace

Eigen::Matrix3d normalise(Storage storage, const Eigen::Matrix3d& matrix) {
  const double scale = scale_of(storage, matrix);
  if (!matrix.allFinite() || !(scale > 0) || !(matrix.determinant() > 0))
    throw InputError(
        fmt::format("matrix to be stored has determinant {} and a {} of {}: it must be finite, and "
                    "both must be positive",
                    matrix.determinant(),
                    storage == Storage::inverse ? "middle entry" : "third column of length", scale));
  const Eigen::Matrix3d rounded = round_to_float(matrix / scale);
  for (int steps = 0; steps <= kMostSteps; ++steps) {
    const Eigen::Matrix3d candidate = towards_larger_determinant(rounded, steps);
    if (candidate.determinant() > 0)
      return candidate;
  }
  throw CheckFailure(
      fmt::format("matrix of determinant {} has no neighbour in single precision with a positive "
                  "one",
                  matrix.determinant()));
}

}  // namespace ltc
