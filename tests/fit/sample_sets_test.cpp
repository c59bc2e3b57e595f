// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/sample_sets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ltc {
namespace {

// Mean of d d^T, a third of the identity for directions that leave none out.
Eigen::Matrix3d second_moment(const std::vector<Eigen::Vector3d>& directions) {
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& d : directions)
    mean += d * d.transpose() / static_cast<double>(directions.size());
  return mean;
}

TEST(Directions, AreEvenlySpread) {
  const auto deviation = [](const std::vector<Eigen::Vector3d>& directions) {
    return (second_moment(directions) - Eigen::Matrix3d::Identity() / 3).norm();
  };
  // Measured: 8.1e-3 and 1.3e-4; independent ones would have 0.09 and 0.01 in the mean.
  EXPECT_LT(deviation(fibonacci_directions(64)), 1e-2);
  EXPECT_LT(deviation(fibonacci_directions(4096)), 2e-4);
  // It would be seen if they were not.
  std::vector<Eigen::Vector3d> half = fibonacci_directions(64);
  half.resize(32);
  EXPECT_GT(deviation(half), 0.1);
}

TEST(Directions, ATurnMovesThemAllAlike) {
  const std::vector<Eigen::Vector3d> straight = fibonacci_directions(64);
  const std::vector<Eigen::Vector3d> turned = turned_directions(64, 5);
  ASSERT_EQ(turned.size(), straight.size());
  for (std::size_t i = 0; i < turned.size(); ++i) {
    EXPECT_NEAR(turned[i].norm(), 1, 1e-14);
    EXPECT_NEAR(turned[i].dot(turned[0]), straight[i].dot(straight[0]), 1e-14);
    EXPECT_GT((turned[i] - straight[i]).norm(), 1e-3) << i;
  }
  EXPECT_EQ(turned, turned_directions(64, 5));
  EXPECT_NE(turned, turned_directions(64, 6));
}

TEST(Directions, TurnsLeaveNoDirectionOut) {
  constexpr int seeds = 3000;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (int seed = 0; seed < seeds; ++seed) {
    const Eigen::Vector3d d = turned_directions(1, static_cast<std::uint64_t>(seed))[0];
    mean += d / seeds;
    second += d * d.transpose() / seeds;
  }
  // A uniform direction's components have variance 1/3, and their products variances of at most
  // 4/45: with five standard errors each of the nine fails one time in 1.7 million.
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 5 * std::sqrt(1.0 / 3 / seeds));
  EXPECT_LT((second - Eigen::Matrix3d::Identity() / 3).cwiseAbs().maxCoeff(),
            5 * std::sqrt(4.0 / 45 / seeds));
}

}  // namespace
}  // namespace ltc
