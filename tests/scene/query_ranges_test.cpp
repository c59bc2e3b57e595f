// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "scene/query_ranges.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ltc {
namespace {

QueryRange range_of(const Material& material) {
  const std::vector<QueryRange> ranges = query_ranges({{material}});
  EXPECT_EQ(ranges.size(), 1u);
  return ranges.front();
}

TEST(QueryRanges, ABoxOfOneLobe) {
  const QueryRange range = range_of({"", RoughnessBox{{0.16, 0.16}, {0.04, 0.04}}, {0.2, 1.0}});
  EXPECT_DOUBLE_EQ(range.roughness_first, 0.4);
  EXPECT_DOUBLE_EQ(range.roughness_last, 0.4);
  EXPECT_DOUBLE_EQ(range.lambda_first, 0.25);
  EXPECT_DOUBLE_EQ(range.lambda_last, 0.25);
  EXPECT_DOUBLE_EQ(range.cos_theta_first, std::cos(1.0));
  EXPECT_DOUBLE_EQ(range.cos_theta_last, std::cos(0.2));
}

TEST(QueryRanges, TheLargerRoughnessComesFirstWhicheverItIs) {
  const QueryRange range = range_of({"", RoughnessBox{{0.04, 0.04}, {0.16, 0.16}}});
  EXPECT_DOUBLE_EQ(range.roughness_first, 0.4);
  EXPECT_DOUBLE_EQ(range.lambda_last, 0.25);
}

TEST(QueryRanges, BoxesThatOverlapReachIsotropy) {
  const QueryRange range = range_of({"", RoughnessBox{{0.1, 0.4}, {0.2, 0.5}}});
  EXPECT_DOUBLE_EQ(range.roughness_first, std::sqrt(0.2));
  EXPECT_DOUBLE_EQ(range.roughness_last, std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(range.lambda_first, 0.2);  // 0.1 over 0.5
  EXPECT_EQ(range.lambda_last, 1);
}

TEST(QueryRanges, OneAMaterialAndIsotropicOnesStayIsotropic) {
  const std::vector<QueryRange> ranges =
      query_ranges({{{"a", PerceptualRoughness{{0.3, 0.3}, {0, 0}}},
                     {"b", PerceptualRoughness{{0.5, 0.5}, {0.6, 0.6}}}}});
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_DOUBLE_EQ(ranges[0].lambda_first, 1);
  EXPECT_DOUBLE_EQ(ranges[0].roughness_first, 0.3);
  const LobeRoughness lobe = lobe_roughness(0.5, 0.6);
  EXPECT_DOUBLE_EQ(ranges[1].lambda_last, lobe.alpha_y / lobe.alpha_x);
}

}  // namespace
}  // namespace ltc
