// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/lobe_quantiles.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

#include "judge/held_out.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

const std::vector<Lobe> lobes = {
    {1e-4, 1e-4, 0.7, 0.3}, {0.1, 0.1, 0.2, 0.9}, {0.3, 0.05, 1.2, 0.6}, {1, 0.5, 0.9, 1.2}};

// The list of one lobe.
std::vector<float> ggx(LobeQuantiles& quantiles, const Lobe& lobe) {
  std::vector<float> list(quantiles.size());
  quantiles.of_ggx(LobeFrame(lobe), list.data());
  return list;
}
std::vector<float> ltc(LobeQuantiles& quantiles, const Lobe& lobe,
                       const Eigen::Matrix3d& matrix) {
  std::vector<float> list(quantiles.size());
  quantiles.of_ltc(LobeFrame(lobe), matrix, list.data());
  return list;
}

TEST(LobeQuantiles, TheDistanceToGgxIsTheHeldOutLossButForTheTails) {
  LobeQuantiles quantiles(4096, 64, 32);
  HeldOutJudge judge(16384, 64);
  for (const Lobe& lobe : lobes) {
    const Eigen::Matrix3d matrix = testing::first_order_matrix(lobe);
    judge.set_lobe(lobe);
    const std::vector<float> a = ggx(quantiles, lobe), b = ltc(quantiles, lobe, matrix);
    const double distance = quantiles.distance(a.data(), b.data());
    // Noise: half a percent of the spread, for both.
    EXPECT_LE(distance, judge.loss(matrix) + 0.005 * judge.spread()) << lobe.alpha_x;
    EXPECT_GE(distance, 0.6 * judge.loss(matrix) - 0.01 * judge.spread()) << lobe.alpha_x;
    EXPECT_NEAR(quantiles.spread(a.data()), judge.spread(), 0.05 * judge.spread()) << lobe.alpha_x;
  }
}

TEST(LobeQuantiles, SeesTheLobeAndNotTheMatrix) {
  LobeQuantiles quantiles(4096, 32, 32);
  for (const Lobe& lobe : lobes) {
    const Eigen::Matrix3d matrix = testing::first_order_matrix(lobe);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const std::vector<float> a = ltc(quantiles, lobe, matrix),
                             same = ltc(quantiles, lobe, 2 * matrix * turn),
                             other = ltc(quantiles, lobe, turn * matrix);
    const double spread = quantiles.spread(a.data());
    EXPECT_EQ(quantiles.distance(a.data(), a.data()), 0);
    EXPECT_LT(quantiles.distance(a.data(), same.data()), 0.003 * spread) << lobe.alpha_x;
    EXPECT_GT(quantiles.distance(a.data(), other.data()), 0.05 * spread) << lobe.alpha_x;
  }
}

TEST(LobeQuantiles, LobesOfTwoViewsAreComparedAsIfOfOne) {
  LobeQuantiles quantiles(2048, 32, 32);
  // Isotropic lobes: the azimuth of the view turns them and nothing else.
  const std::vector<float> a = ggx(quantiles, {0.01, 0.01, 0.2, 0}),
                           b = ggx(quantiles, {0.01, 0.01, 0.25, 0}),
                           wider = ggx(quantiles, {0.02, 0.02, 0.2, 0});
  const double spread = quantiles.spread(a.data());
  // Their mirror directions are ten times as far apart as the lobes are wide.
  EXPECT_LT(quantiles.distance(a.data(), b.data()), 0.05 * spread);
  EXPECT_GT(quantiles.distance(a.data(), wider.data()), 0.5 * spread);
}

}  // namespace
}  // namespace ltc
