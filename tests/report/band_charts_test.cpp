// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The page's charts of quality over a parameter.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "report/validation_pictures.h"

namespace ltc {
namespace {

TEST(BandCharts, AMeanIsALevelLineAcrossItsBand) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  QualityReport quality;
  quality.bands = {{"theta", "°", {{0, 30, 5, 0.1, 0.05, 0.02, 0.01}, {75, infinity, 5, 0.4, 0.2}}},
                   {"lambda", "", {}}};
  const std::vector<picture::Chart> charts = band_charts(quality);
  ASSERT_EQ(charts.size(), 2u);  // loss and light; nothing of a parameter without bands
  EXPECT_EQ(charts[0].words.title, "Loss between nodes by theta");
  EXPECT_EQ(charts[1].words.title, "Error under area lights by theta");
  EXPECT_EQ(charts[0].series[0].name, "floor");
  const picture::Series& table = charts[0].series[1];
  ASSERT_EQ(table.points.size(), 4u);
  EXPECT_EQ(table.points[0].x, 0);
  EXPECT_EQ(table.points[1].x, 30);
  EXPECT_EQ(table.points[1].y, 0.1);
  EXPECT_EQ(table.points[3].x, 90);  // where an open band of angles ends
  EXPECT_EQ(table.points[3].y, 0.4);
  EXPECT_EQ(charts[0].words.lines_below,
            (std::vector<std::string>{"table  0.100  0.400", "floor  0.050  0.200"}));
  EXPECT_EQ(charts[0].y.scale->first(), 0);
  EXPECT_GT(charts[0].y.scale->last(), 0.4);
}

TEST(BandCharts, WhatIsNoNumberIsADash) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  QualityReport quality;
  quality.bands = {{"lambda", "", {{0, 0.5, 5, nan, 0.1, nan, nan}}}};
  const picture::Chart chart = band_charts(quality).at(0);
  EXPECT_EQ(chart.words.lines_below, (std::vector<std::string>{"table  –", "floor  0.100"}));
}

}  // namespace
}  // namespace ltc
