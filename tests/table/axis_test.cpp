// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Axes: warps there and back, node placement, clamping, refusals.
#include "table/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace ltc {
namespace {

constexpr Warp all_warps[] = {Warp::linear, Warp::sqrt, Warp::complement_sqrt};

TEST(Axis, CoordinateUndoesValueForEveryWarp) {
  for (const Warp warp : all_warps) {
    const Axis axis = Axis::make(0.25, 1.5, 7, warp);
    for (double u = 0; u <= 1; u += 1.0 / 64)
      // The square root turns an error of one unit in the last place of x, near x = 0, into its
      // root; away from the ends it is 1e-15.
      EXPECT_NEAR(axis.coordinate(axis.value(u)), u, 2e-8) << name_of(warp) << " u = " << u;
  }
}

TEST(Axis, NodesStandAtEqualStepsOfTheCoordinateAndEndAtTheEnds) {
  for (const Warp warp : all_warps) {
    const Axis axis = Axis::make(0.1, 0.7, 5, warp);
    ASSERT_EQ(axis.size(), 5u);
    EXPECT_EQ(axis.first(), 0.1);
    EXPECT_EQ(axis.last(), 0.7);
    for (std::size_t i = 0; i < axis.size(); ++i)
      EXPECT_NEAR(axis.coordinate(axis.nodes[i]), static_cast<double>(i) / 4, 1e-12);
  }
}

TEST(Axis, WarpsAreDenseWhereTheyClaim) {
  // By hand: x = u^2 and x = 1 - (1 - u)^2 at u = 1/4.
  EXPECT_DOUBLE_EQ(Axis::make(0, 1, 5, Warp::linear).nodes[1], 0.25);
  EXPECT_DOUBLE_EQ(Axis::make(0, 1, 5, Warp::sqrt).nodes[1], 0.0625);
  EXPECT_DOUBLE_EQ(Axis::make(0, 1, 5, Warp::complement_sqrt).nodes[1], 0.4375);
  EXPECT_DOUBLE_EQ(Axis::make(0, 1, 5, Warp::sqrt).coordinate(0.25), 0.5);
  EXPECT_DOUBLE_EQ(Axis::make(0, 1, 5, Warp::complement_sqrt).coordinate(0.75), 0.5);
}

TEST(Axis, CoordinateIsClampedAndNanStaysNan) {
  for (const Warp warp : all_warps) {
    const Axis axis = Axis::make(0.1, 0.7, 4, warp);
    EXPECT_EQ(axis.coordinate(-3), 0);
    EXPECT_EQ(axis.coordinate(8), 1);
    EXPECT_TRUE(std::isnan(axis.coordinate(std::numeric_limits<double>::quiet_NaN())));
  }
}

TEST(Axis, OneNodeStandsAtFirstAndTakesEveryValue) {
  const Axis axis = Axis::make(0.3, 0.3, 1, Warp::sqrt);
  EXPECT_EQ(axis.nodes, std::vector<double>{0.3});
  EXPECT_EQ(axis.coordinate(0.1), 0);
  EXPECT_EQ(axis.coordinate(0.9), 0);
  EXPECT_EQ(axis.value(0), 0.3);
}

TEST(Axis, RefusesWhatIsNoAxis) {
  EXPECT_THROW(Axis::make(0, 1, 0, Warp::linear), InputError);
  EXPECT_THROW(Axis::make(1, 0, 2, Warp::linear), InputError);
  EXPECT_THROW(Axis::make(1, 1, 2, Warp::linear), InputError);
  EXPECT_THROW(Axis::make(0, std::numeric_limits<double>::infinity(), 2, Warp::linear), InputError);
}

TEST(Axis, WarpNamesGoThereAndBackAndOthersAreRefused) {
  for (const Warp warp : all_warps)
    EXPECT_EQ(value_named<Warp>(name_of(warp)), warp);
  EXPECT_EQ(name_of(Warp::complement_sqrt), "complement-sqrt");
  EXPECT_THROW(value_named<Warp>("cubic"), InputError);
  EXPECT_THROW(value_named<Warp>(""), InputError);
}

}  // namespace
}  // namespace ltc
