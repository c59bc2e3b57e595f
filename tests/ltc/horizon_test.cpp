// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "ltc/horizon.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace ltc {
namespace {

using Eigen::Vector3d;

// A lobe that reaches far below the horizon, as it is and folded.
std::vector<LtcLobe> low_lobes() {
  Eigen::Matrix3d matrix;
  matrix << 0.6, 0.1, 0.9, -0.2, 0.3, 0.1, 0.2, 0.1, 0.3;
  std::vector<LtcLobe> lobes{matrix};
  lobes.push_back({matrix, {-1.2, 0.4}, usual_creases});
  lobes.push_back({matrix, {0.7, -0.5}, two_pairs_of_creases});
  return lobes;
}

double share_above(const LtcLobe& lobe) {
  const FoldedCosine cosine(lobe);
  double sum = 0;
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      sum += std::abs(
          cosine.integrate_polygon(std::array<Vector3d, 3>{{{x, 0, 0}, {0, y, 0}, {0, 0, 1}}}));
  return sum;
}

TEST(Horizon, WhatIsAboveIsScaledToOne) {
  for (const LtcLobe& lobe : low_lobes()) {
    const double above = share_above(lobe);
    ASSERT_LT(above, 0.95);
    // Sums of four integrals in double.
    EXPECT_NEAR(above * horizon_factor(lobe, HorizonMode::scaled), 1, 1e-13);
    EXPECT_EQ(horizon_factor(lobe, HorizonMode::clipped), 1);
  }
}

TEST(Horizon, NothingIsScaledByMoreThanSixteen) {
  EXPECT_EQ(horizon_factor(Eigen::Matrix3d(Vector3d(1, 1, -1).asDiagonal()), HorizonMode::scaled),
            16);
  EXPECT_EQ(horizon_factor(Eigen::Matrix3d::Identity(), HorizonMode::scaled), 1);
}

}  // namespace
}  // namespace ltc
