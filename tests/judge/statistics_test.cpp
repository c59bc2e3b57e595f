// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ltc {
namespace {

constexpr double nan = Statistics::none;

// NaN, then 100 to 1.
std::vector<double> falling() {
  std::vector<double> values = {nan};
  for (int i = 100; i >= 1; --i)
    values.push_back(i);
  return values;
}

TEST(Statistics, OfKnownValues) {
  const Statistics all = statistics_of(falling());
  EXPECT_EQ(all.count, 100u);
  EXPECT_DOUBLE_EQ(all.mean, 50.5);
  // The variance of 1..100 is 100 * 101 / 12.
  EXPECT_NEAR(all.standard_error, std::sqrt(100.0 * 101 / 12 / 100), 1e-12);
  EXPECT_EQ(all.p50, 50);
  EXPECT_EQ(all.p95, 95);
  EXPECT_EQ(all.p99, 99);
  EXPECT_EQ(all.largest, 100);
  EXPECT_EQ(all.largest_index, 1u);
}

TEST(Statistics, OfThoseThatAreIncluded) {
  std::vector<bool> include(101);
  include[0] = include[91] = include[96] = true;
  const Statistics two = statistics_of(falling(), include);
  EXPECT_EQ(two.count, 2u);
  EXPECT_EQ(two.mean, 7.5);
  EXPECT_EQ(two.p50, 5);
  EXPECT_EQ(two.largest_index, 91u);
}

TEST(Statistics, OfNothing) {
  for (const std::vector<double>& values : {std::vector<double>{}, {nan, nan}}) {
    const Statistics none = statistics_of(values);
    EXPECT_EQ(none.count, 0u);
    EXPECT_TRUE(std::isnan(none.mean));
    EXPECT_TRUE(std::isnan(none.p95));
  }
  EXPECT_TRUE(std::isnan(statistics_of(std::vector<double>{1}).standard_error));
}

TEST(Statistics, WhatIsInfiniteCounts) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Statistics statistics = statistics_of(std::vector<double>{1, infinity, 2});
  EXPECT_EQ(statistics.count, 3u);
  EXPECT_EQ(statistics.mean, infinity);
  EXPECT_EQ(statistics.p50, 2);
  EXPECT_EQ(statistics.largest_index, 1u);
}

}  // namespace
}  // namespace ltc
