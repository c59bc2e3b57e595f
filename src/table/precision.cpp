// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/precision.h"

namespace ltc {

Eigen::Matrix3d rounded(const Eigen::Matrix3d& matrix, Precision precision) {
  return matrix.unaryExpr([=](double value) -> double {
    const auto single = static_cast<float>(value);
    return precision == Precision::half ? static_cast<float>(Eigen::half(single)) : single;
  });
}

}  // namespace ltc
