// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "stress/graded_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/angle.h"
#include "fit/starting_points.h"
#include "judge/held_out.h"

namespace ltc {
namespace {

Eigen::Matrix3d first_order(const Lobe& lobe) {
  const LobeFrame frame(lobe);
  return frame.to_matrix(admissible(frame.first_order, free_entries(lobe)));
}

// P0 is exact as the roughness goes to zero: what is left is the judge's noise. Equally weighted
// samples of the same number see 3 % of the spread.
TEST(GradedJudge, SeesThatSharpLobesAreExact) {
  GradedJudge judge(8192, 32, 1);
  HeldOutJudge equally_weighted(8192, 32, 1);
  for (const Lobe& lobe :
       {Lobe{1e-6, 1e-6, 0, 0}, Lobe{1e-5, 1e-6, 0.9, 0.4}, Lobe{1e-6, 1e-12, 0.5, 1.2}}) {
    judge.set_lobe(lobe);
    equally_weighted.set_lobe(lobe);
    EXPECT_LT(judge.loss(first_order(lobe)), 0.007 * judge.spread());
    EXPECT_LT(judge.noise(), 0.007 * judge.spread());
    EXPECT_GT(judge.noise(), 0);
    EXPECT_GT(equally_weighted.loss(first_order(lobe)), 0.015 * equally_weighted.spread());
  }
}

// A lobe 5 % too wide is off by about 5 % of its spread.
TEST(GradedJudge, SeesWhatIsWrong) {
  GradedJudge judge(4096, 32, 1);
  const Lobe lobe{1e-4, 1e-5, 0.7, 0.3};
  judge.set_lobe(lobe);
  Eigen::Matrix3d wide = first_order(lobe);
  wide.leftCols<2>() *= 1.05;
  EXPECT_NEAR(judge.loss(wide) / judge.spread(), 0.05, 0.01);
  EXPECT_NEAR(judge.loss(-1e6 * wide.rowwise().reverse().eval()), 2, 2) << "anything finite";
}

// On a rough lobe both judges have little noise: they differ by directions and samples alone.
TEST(GradedJudge, AgreesWithTheJudgeOfTables) {
  const Lobe lobe{0.5, 0.3, 0.6, 0.4};
  const Eigen::Matrix3d matrix = first_order(lobe);
  GradedJudge graded(8192, 64, 7);
  HeldOutJudge held_out(8192, 64, 7);
  graded.set_lobe(lobe);
  held_out.set_lobe(lobe);
  EXPECT_NEAR(graded.loss(matrix), held_out.loss(matrix), 0.01 * held_out.loss(matrix));
  const double folded = held_out.loss({matrix, {-0.8, 0.3}, usual_creases});
  EXPECT_NEAR(graded.loss(matrix, {-0.8, 0.3}, usual_creases), folded, 0.01 * folded);
  EXPECT_GT(folded, 1.1 * held_out.loss(matrix)) << "a fold is seen";
  EXPECT_NEAR(graded.spread(), held_out.spread(), 0.01 * held_out.spread());
}

TEST(GradedJudge, SaysNothingOfWhatIsNotAMatrix) {
  GradedJudge judge(256, 8, 1);
  judge.set_lobe({0.5, 0.3, 0.6, 0.4});
  EXPECT_TRUE(
      std::isnan(judge.loss(Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN()))));
  EXPECT_TRUE(std::isnan(judge.loss(Eigen::Matrix3d::Zero())));
}

}  // namespace
}  // namespace ltc
