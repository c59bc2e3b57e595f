// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/precision.h"

namespace ltc {

float rounded(float value, Precision precision) {
  return precision == Precision::half ? static_cast<float>(Eigen::half(value)) : value;
}

Eigen::Matrix3d rounded(const Eigen::Matrix3d& matrix, Precision precision) {
  return matrix.unaryExpr(
      [=](double value) -> double { return rounded(static_cast<float>(value), precision); });
}

}  // namespace ltc
