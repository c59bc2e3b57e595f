// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/query_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "table/synthetic.h"

namespace ltc {
namespace {

const double nan = std::nan("");

Grid grid_of_alpha(double first, double last) {
  Grid grid = Grid::paper(2);
  grid.alpha = Axis::make(first, last, 2, Warp::linear);
  return grid;
}

QualitySettings quick_settings() {
  QualitySettings settings;
  settings.queries = 24;
  settings.query_samples = 1024;
  settings.query_directions = 8;
  settings.quads = 8;
  settings.quad_samples = 1024;
  return settings;
}

TEST(CommonRange, IsWhatBothTablesServe) {
  const auto common = common_range(grid_of_alpha(0.04, 0.49), grid_of_alpha(0.16, 1));
  ASSERT_TRUE(common);
  EXPECT_DOUBLE_EQ(common->roughness_first, 0.4);
  EXPECT_DOUBLE_EQ(common->roughness_last, 0.7);
  EXPECT_EQ(common->lambda_first, 0);
  EXPECT_EQ(common->lambda_last, 1);
  EXPECT_FALSE(common_range(grid_of_alpha(0.04, 0.1), grid_of_alpha(0.16, 1)));
}

// The second table is finer, its grid another: so its look-ups are nearer to what the matrix is a
// function of.
TEST(CompareQueries, JudgesEachTableAsMeasureQualityDoes) {
  const Table coarse = testing::synthetic_table(Grid::paper(2), Storage::matrix),
              fine = testing::synthetic_table(Grid::paper({4, 3, 5, 4}), Storage::matrix);
  const QualitySettings settings = quick_settings();
  const std::vector<QueryComparison> queries = compare_queries(coarse, fine, settings, {2});
  ASSERT_EQ(queries.size(), settings.queries);
  std::vector<QueryFloor> floors;
  for (const QueryComparison& query : queries)
    floors.emplace_back().lobe = query.lobe;
  const QualityReport of_coarse = measure_quality(coarse, settings, floors, {2}),
                      of_fine = measure_quality(fine, settings, floors, {2});
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const QueryComparison& query = queries[i];
    ASSERT_TRUE(query.judged());
    EXPECT_EQ(query.lobes.loss_a / query.lobes.spread, of_coarse.queries[i].relative_loss) << i;
    // B is turned to A, and its samples with it: by their noise, some thousandths of the spread
    // with so few.
    EXPECT_NEAR(query.lobes.loss_b / query.lobes.spread, of_fine.queries[i].relative_loss, 0.02)
        << i;
    EXPECT_EQ(query.area_light_a, of_coarse.queries[i].area_light.mean_absolute) << i;
    // A turn about z changes nothing in exact arithmetic, and B is not turned here.
    EXPECT_EQ(query.area_light_b, of_fine.queries[i].area_light.mean_absolute) << i;
    EXPECT_EQ(query.with_amplitude_b, of_fine.queries[i].area_light_with_amplitude.mean_absolute)
        << i;
  }
  const QuerySummary summary = summarize_queries(queries);
  EXPECT_EQ(summary.judged, settings.queries);
  EXPECT_GT(summary.look_ups.a.mean, summary.look_ups.b.mean);
}

TEST(CompareQueries, SameBitsWithAnyNumberOfThreads) {
  const Table a = testing::synthetic_table(Grid::paper(2), Storage::matrix),
              b = testing::synthetic_table(Grid::paper(3), Storage::mirror_frame);
  const std::vector<QueryComparison> one = compare_queries(a, b, quick_settings(), {1}),
                                     three = compare_queries(a, b, quick_settings(), {3});
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].lobes.loss_a, three[i].lobes.loss_a);
    EXPECT_EQ(one[i].lobes.distance, three[i].lobes.distance);
    EXPECT_EQ(one[i].area_light_b, three[i].area_light_b);
  }
}

TEST(CompareQueries, CountsWhatATableCannotAnswer) {
  const Table whole = testing::synthetic_table(Grid::paper(2), Storage::matrix);
  Table part = whole, singular = whole;
  const std::size_t plane = part.grid.size() / 2;  // all of alpha = 1
  for (std::size_t flat = plane; flat < part.grid.size(); ++flat) {
    part.set_stored(flat, Eigen::Matrix3d::Constant(nan));
    part.status[flat] = Status::skipped;
  }
  for (std::size_t flat = 0; flat < part.grid.size(); ++flat)
    singular.set_stored(flat, Eigen::Matrix3d::Zero());
  const std::size_t all = quick_settings().queries;
  const auto summary = [](const Table& a, const Table& b) {
    return summarize_queries(compare_queries(a, b, quick_settings(), {2}));
  };
  const QuerySummary lacking = summary(whole, part);
  EXPECT_EQ(lacking.judged, 0u);
  EXPECT_EQ(lacking.missing_a, 0u);
  EXPECT_EQ(lacking.missing_b, all);
  EXPECT_EQ(lacking.look_ups.difference.count, 0u);
  EXPECT_EQ(lacking.look_ups.sign(), 0);
  const QuerySummary flat = summary(singular, whole);
  EXPECT_EQ(flat.singular_a, all);
  EXPECT_EQ(flat.singular_b, 0u);
  Table low = testing::synthetic_table(grid_of_alpha(0, 0.09), Storage::matrix);
  const QuerySummary beyond = summary(whole, low);
  EXPECT_GT(beyond.outside, all / 2);  // those of a roughness above 0.3
  EXPECT_EQ(beyond.outside + beyond.judged, all);
}

TEST(Verdict, IsOfTheMeanOfThePairs) {
  // Differences of -1 and -3: mean -2, standard error 1.
  const Verdict within = verdict_of({1, 2, nan}, {2, 5, 1});
  EXPECT_EQ(within.difference.count, 2u);
  EXPECT_EQ(within.difference.mean, -2);
  EXPECT_DOUBLE_EQ(within.difference.standard_error, 1);
  EXPECT_EQ(within.sign(), 0) << "two standard errors are not more than two";
  EXPECT_EQ(within.a_nearer, 2u);
  EXPECT_EQ(within.a.mean, 1.5);
  EXPECT_EQ(within.b.mean, 3.5) << "the third is in no pair";
  EXPECT_EQ(verdict_of({1, 2}, {2, 4.9}).sign(), -1);
  EXPECT_EQ(verdict_of({2, 4.9}, {1, 2}).sign(), 1);
  EXPECT_EQ(verdict_of({1, 2}, {1, 2}).sign(), 0);
  EXPECT_EQ(verdict_of({}, {}).sign(), 0);
  // Always behind by the same is behind for sure, and infinitely far is behind.
  EXPECT_EQ(verdict_of({2, 3}, {1, 2}).sign(), 1);
  EXPECT_EQ(verdict_of({2, std::numeric_limits<double>::infinity()}, {1, 2}).sign(), 1);
}

}  // namespace
}  // namespace ltc
