// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/quality_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ltc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Four queries of perceptual roughness 0.15, 0.15, 0.5 and 0.5; the last is left out.
QualityReport four_queries() {
  QualityReport report;
  report.settings.quads = 4;
  report.node_losses = {0.1, 0.3, nan, 0.2};
  for (const double roughness : {0.15, 0.15, 0.5, 0.5}) {
    QueryFloor floor;
    floor.lobe = {roughness * roughness, 0.5 * roughness * roughness, 1.0, 0.2};
    floor.relative_loss = 0.05;
    floor.area_light = {0.01, 0.02, 4e-4};
    report.floors.push_back(floor);
  }
  for (const double loss : {0.2, 0.4, 0.06})
    report.queries.push_back({QueryState::judged, loss, {loss / 10, loss, 4e-4}, {loss, loss, 0}});
  report.queries.push_back({QueryState::missing, nan, {nan, nan, nan}, {nan, nan, nan}});
  return report;
}

TEST(QualitySummary, OfKnownValues) {
  QualityReport report = four_queries();
  summarize_quality(report);
  EXPECT_EQ(report.nodes.count, 3u);
  EXPECT_NEAR(report.nodes.mean, 0.2, 1e-15);
  EXPECT_EQ(report.nodes.largest_index, 1u);
  EXPECT_NEAR(report.query_losses.mean, 0.22, 1e-15);
  EXPECT_NEAR(report.area_light.mean, 0.022, 1e-15);
  EXPECT_NEAR(report.area_light_with_amplitude.mean, 0.22, 1e-15);
  EXPECT_EQ(report.floor_losses.count, 3u);  // of the judged queries alone
  EXPECT_EQ(report.queries_missing, 1u);
  EXPECT_NEAR(report.area_light_noise, 4e-4, 1e-15);
  EXPECT_NEAR(report.area_light_mean_noise, 4e-4 / std::sqrt(12), 1e-15);
  EXPECT_EQ(report.worst_queries, (std::vector<std::size_t>{1, 0, 2}));
}

TEST(QualitySummary, BandsHoldTheirQueriesAndNoEmptyOnesStand) {
  QualityReport report = four_queries();
  summarize_quality(report);
  ASSERT_EQ(report.bands.size(), 4u);
  const std::vector<Band>& roughness = report.bands[0].bands;
  ASSERT_EQ(roughness.size(), 2u);
  EXPECT_EQ(roughness[0].first, 0.1);
  EXPECT_EQ(roughness[0].last, 0.2);
  EXPECT_EQ(roughness[0].queries, 2u);
  EXPECT_NEAR(roughness[0].relative_loss, 0.3, 1e-15);
  EXPECT_NEAR(roughness[0].floor_loss, 0.05, 1e-15);
  EXPECT_NEAR(roughness[0].area_light_error, 0.03, 1e-15);
  EXPECT_EQ(roughness[1].first, 0.4);
  EXPECT_EQ(roughness[1].queries, 1u);
  for (const Bands& bands : report.bands) {
    std::size_t queries = 0;
    for (const Band& band : bands.bands)
      queries += band.queries;
    EXPECT_EQ(queries, 3u) << bands.parameter;
  }
}

TEST(QualityThresholds, NameWhatIsPassed) {
  QualityReport report = four_queries();
  summarize_quality(report);
  const std::vector<ThresholdCheck> checks = check_thresholds(report, {0.21, 0.2, 0.022001});
  ASSERT_EQ(checks.size(), 3u);
  EXPECT_TRUE(checks[0].passed);
  EXPECT_EQ(checks[1].key, "quality.query_loss");
  EXPECT_FALSE(checks[1].passed);
  EXPECT_NEAR(checks[1].value, 0.22, 1e-15);
  EXPECT_EQ(checks[1].limit, 0.2);
  EXPECT_TRUE(checks[2].passed);
  EXPECT_FALSE(check_thresholds(report, {0.19, 1, 1})[0].passed);
  EXPECT_FALSE(check_thresholds(report, {1, 1, 0.0219})[2].passed);
}

TEST(QualityThresholds, NothingJudgedIsNothingPassed) {
  QualityReport report;
  summarize_quality(report);
  for (const ThresholdCheck& check : check_thresholds(report, {0, 0, 0})) {
    EXPECT_TRUE(check.passed) << check.key;
    EXPECT_TRUE(std::isnan(check.value)) << check.key;
    EXPECT_EQ(verdict_text(check), "not judged");
  }
  EXPECT_FALSE(std::signbit(report.area_light_noise)) << "printed as -nan";
}

TEST(QualityThresholds, AFewOfManyQueriesAreNotJudgedByALimit) {
  QualityReport report = four_queries();
  summarize_quality(report);
  EXPECT_TRUE(check_thresholds(report, {1, 1, 1})[1].judged());  // few, but of few
  report.queries.resize(200, {QueryState::outside, 0, {}, {}, 0});
  const std::vector<ThresholdCheck> checks = check_thresholds(report, {1, 0, 0});
  EXPECT_TRUE(checks[0].judged());
  for (const std::size_t of_queries : {1, 2})
    EXPECT_EQ(verdict_text(checks[of_queries]), "not judged");
}

TEST(QualityThresholds, WhatIsDemandedMustBeJudged) {
  QualityReport report;
  summarize_quality(report);
  const std::vector<ThresholdCheck> checks =
      check_thresholds(report, {1, 1, 1}, {"quality.query_loss"});
  EXPECT_TRUE(checks[0].passed);
  EXPECT_FALSE(checks[1].passed);
  EXPECT_EQ(verdict_text(checks[1]), "not judged");
  EXPECT_EQ(failure_line(checks[1]),
            "mean relative loss between nodes is not judged, for there is too little to judge, but "
            "quality.query_loss = 1 is demanded");
  report = four_queries();
  summarize_quality(report);
  EXPECT_TRUE(check_thresholds(report, {1, 1, 1}, {"quality.query_loss"})[1].passed);
}

}  // namespace
}  // namespace ltc
