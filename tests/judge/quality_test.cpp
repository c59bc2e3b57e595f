// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/quality.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "export/table_file.h"
#include "judge/held_out.h"
#include "judge/quality_summary.h"
#include "pipeline/generate.h"
#include "support/reference.h"

namespace ltc {
namespace {

// A whole table with 4 nodes an axis: a second of work for all tests together.
const Table& small_table() {
  static const Table table = [] {
    Config config = load_config(std::nullopt, {});
    config.grid = Grid::paper(4);
    config.refine.steps = 0;
    return generate_table(config, {2});
  }();
  return table;
}

// Little work, for what does not depend on samples.
QualitySettings quick_settings() {
  QualitySettings settings;
  settings.node_samples = settings.query_samples = 1024;
  settings.node_directions = settings.query_directions = 8;
  settings.quad_samples = 1024;
  settings.queries = 40;
  settings.floor_fit = FitSettings{};
  return settings;
}

const std::vector<QueryFloor>& quick_floors() {
  static const std::vector<QueryFloor> floors =
      fit_queries(quick_settings(), small_table().grid, {2});
  return floors;
}

QualityReport quick_report(const Table& table) {
  return measure_quality(table, quick_settings(), quick_floors(), {2});
}

void expect_same(const Statistics& a, const Statistics& b) {
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.p99, b.p99);
  EXPECT_EQ(a.largest_index, b.largest_index);
}

TEST(Quality, SameBitsWithAnyNumberOfThreads) {
  QualitySettings settings = quick_settings();
  settings.queries = 12;
  settings.most_nodes = 30;
  const QualityReport one = measure_quality(small_table(), settings, {1});
  const QualityReport three = measure_quality(small_table(), settings, {3});
  expect_same(one.nodes, three.nodes);
  expect_same(one.query_losses, three.query_losses);
  expect_same(one.floor_losses, three.floor_losses);
  expect_same(one.area_light, three.area_light);
  expect_same(one.area_light_with_amplitude, three.area_light_with_amplitude);
  EXPECT_EQ(one.worst_queries, three.worst_queries);
  EXPECT_EQ(one.nodes.count, 30u);
}

// The small table's nodes are such fits, aligned and rounded; those that symmetry copies are those
// of a turned lobe, whose samples are others.
TEST(Quality, NodesAgainstFitsOfTheirOwn) {
  QualitySettings settings = quick_settings();
  settings.fitted_nodes = 20;
  const QualityReport same = measure_quality(small_table(), settings, quick_floors(), {2});
  EXPECT_EQ(same.node_fits.count, 20u);
  EXPECT_NEAR(same.node_fits.p50, 1, 1e-3);
  EXPECT_NEAR(same.node_fits.mean, 1, 0.02);
  Table widened = small_table();
  for (std::size_t flat = 0; flat < widened.grid.size(); ++flat) {
    Eigen::Matrix3d stored = widened.stored_at(flat);
    stored.col(0) *= 1.5;
    widened.set_stored(flat, stored);
  }
  const QualityReport worse = measure_quality(widened, settings, quick_floors(), {2});
  EXPECT_GT(worse.node_fits.mean, 1.5);
  EXPECT_EQ(quick_report(small_table()).node_fits.count, 0u);
}

TEST(Quality, FloorsCanBeShared) {
  const QualityReport own = measure_quality(small_table(), quick_settings(), {2});
  const QualityReport shared = quick_report(small_table());
  expect_same(own.query_losses, shared.query_losses);
  expect_same(own.floor_losses, shared.floor_losses);
}

TEST(Quality, TheFloorIsBelowTheTable) {
  const QualityReport report = quick_report(small_table());
  // Four nodes an axis are far too few: three quarters of the error between them are theirs.
  EXPECT_LT(report.floor_losses.mean, 0.5 * report.query_losses.mean);
  EXPECT_LT(report.floor_area_light.mean, 0.5 * report.area_light.mean);
  for (std::size_t i = 0; i < report.queries.size(); ++i)
    // A fit may miss the held-out optimum by the noise of its samples and of these few.
    EXPECT_LT(report.floors[i].relative_loss, 1.1 * report.queries[i].relative_loss + 0.01) << i;
}

TEST(Quality, AFoldedFloorIsBelowThatOfLtcs) {
  QualitySettings settings = quick_settings();
  const auto mean_loss = [&] {
    double sum = 0;
    for (const QueryFloor& floor : fit_queries(settings, small_table().grid, {2}))
      sum += floor.relative_loss;
    return sum;
  };
  const double plain = mean_loss();
  settings.floor_fit.lobe = LobeKind::folded;
  // Of 1,200 queries 0.41 times; few samples here.
  EXPECT_LT(mean_loss(), 0.7 * plain);
}

TEST(Quality, TheHorizonIsThatOfTableAndFloor) {
  QualitySettings settings = quick_settings();
  settings.horizon = HorizonMode::scaled;
  const QualityReport scaled = measure_quality(small_table(), settings, {2});
  const QualityReport clipped = quick_report(small_table());
  EXPECT_LT(scaled.floor_losses.mean, 0.95 * clipped.floor_losses.mean);
  EXPECT_NE(scaled.nodes.mean, clipped.nodes.mean);
  EXPECT_NE(scaled.query_losses.mean, clipped.query_losses.mean);
  EXPECT_NE(scaled.area_light.mean, clipped.area_light.mean);
  EXPECT_NE(scaled.area_light_with_amplitude.mean, clipped.area_light_with_amplitude.mean);
  EXPECT_LT(scaled.floor_area_light.mean, 0.95 * clipped.floor_area_light.mean);
  EXPECT_GT(scaled.floor_below_horizon.mean, clipped.floor_below_horizon.mean);
  EXPECT_EQ(scaled.below_horizon.mean, clipped.below_horizon.mean);
}

// Queries at nodes, which take nothing from other nodes.
std::vector<QueryFloor> floors_at_nodes(const Grid& grid) {
  std::vector<QueryFloor> floors(grid.lambda.size());
  for (std::size_t i = 0; i < floors.size(); ++i) {
    floors[i].lobe = grid.lobe({1, i, 2, 1});
    floors[i].area_light = {0.01, 0.01, 1e-4};
  }
  return floors;
}

// The nodes of a table are fits of their very lobes: there a table is at its floor.
TEST(Quality, QueriesAtNodesAreAsGoodAsTheNodes) {
  const Table& table = small_table();
  QualitySettings settings = quick_settings();
  settings.most_nodes = 0;
  settings.query_directions = 64;
  const std::vector<QueryFloor> floors = floors_at_nodes(table.grid);
  const QualityReport report = measure_quality(table, settings, floors, {2});
  for (std::size_t i = 0; i < floors.size(); ++i) {
    HeldOutJudge judge(1024, 64, 1);
    judge.set_lobe(floors[i].lobe);
    const double at_node = judge.loss(table.matrix_at(table.grid.flat({1, i, 2, 1})));
    // The same loss by two sets of 64 directions. Their ratio has a standard deviation of 4 %.
    EXPECT_NEAR(report.queries[i].relative_loss * judge.spread() / at_node, 1, 0.16) << i;
  }
}

TEST(Quality, ARotatedEntryRaisesTheFigures) {
  Table spoiled = small_table();
  const std::size_t flat = spoiled.grid.flat({1, 2, 2, 1});
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(std::numbers::pi / 6, Eigen::Vector3d::UnitX()).toRotationMatrix();
  spoiled.set_stored(flat, turn * spoiled.stored_at(flat));
  const std::vector<QueryFloor> floors = floors_at_nodes(spoiled.grid);
  const QualityReport before = measure_quality(small_table(), quick_settings(), floors, {2});
  const QualityReport after = measure_quality(spoiled, quick_settings(), floors, {2});
  EXPECT_GT(after.node_losses[flat], 3 * before.node_losses[flat]);
  EXPECT_GT(after.nodes.mean, before.nodes.mean);
  EXPECT_GT(after.queries[2].relative_loss, 3 * before.queries[2].relative_loss);
  EXPECT_GT(after.query_losses.mean, 1.5 * before.query_losses.mean);
  EXPECT_GT(after.area_light.mean, 1.5 * before.area_light.mean);
  EXPECT_EQ(after.worst_queries[0], 2u);
  // And nothing else changes.
  for (std::size_t other = 0; other < after.node_losses.size(); ++other)
    EXPECT_EQ(after.node_losses[other] == before.node_losses[other], other != flat) << other;
}

TEST(Quality, AWrongAmplitudeShowsInTheLightAloneThatUsesIt) {
  Table spoiled = small_table();
  for (float& amplitude : spoiled.amplitude)
    amplitude *= 1.2f;
  const QualityReport before = quick_report(small_table()), after = quick_report(spoiled);
  EXPECT_GT(after.area_light_with_amplitude.mean, 1.2 * before.area_light_with_amplitude.mean);
  expect_same(after.area_light, before.area_light);
  expect_same(after.query_losses, before.query_losses);
}

TEST(Quality, ATableWithoutAmplitudesIsJudgedByItsShapes) {
  Table table = small_table();
  std::fill(table.amplitude.begin(), table.amplitude.end(),
            std::numeric_limits<float>::quiet_NaN());
  const QualityReport report = quick_report(table);
  EXPECT_EQ(report.area_light_with_amplitude.count, 0u);
  EXPECT_EQ(report.area_light.count, 40u);
  EXPECT_EQ(report.queries_singular, 0u);
}

TEST(Quality, WhatNeedsASkippedEntryIsCountedAndLeftOut) {
  Table table = small_table();
  const Table empty = Table::empty(table.grid, table.storage);
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat)
    if (table.grid.node(flat).alpha == 3) {
      table.status[flat] = Status::skipped;
      table.set_stored(flat, empty.stored_at(flat));
    }
  const QualityReport report = quick_report(table);
  std::size_t needing = 0;
  for (const QueryFloor& floor : quick_floors())
    needing += floor.lobe.alpha_x > 2.0 / 3;
  ASSERT_GT(needing, 0u);
  EXPECT_EQ(report.queries_missing, needing);
  EXPECT_EQ(report.query_losses.count, 40 - needing);
  EXPECT_EQ(report.nodes_without_values, 64u);
  EXPECT_EQ(report.nodes.count, 192u);
  EXPECT_TRUE(std::isfinite(report.query_losses.mean));
  EXPECT_TRUE(std::isfinite(report.floor_losses.mean));
}

TEST(Quality, WhatIsBeyondTheAxesIsCountedAndLeftOut) {
  Table table = small_table();
  for (double& alpha : table.grid.alpha.nodes)
    alpha *= 0.5;
  const QualityReport report = quick_report(table);
  std::size_t beyond = 0;
  for (const QueryFloor& floor : quick_floors())
    beyond += floor.lobe.alpha_x > 0.501;
  ASSERT_GT(beyond, 0u);
  EXPECT_EQ(report.queries_outside, beyond);
  EXPECT_EQ(report.query_losses.count, 40 - beyond);
}

TEST(Quality, ASingularMatrixIsCounted) {
  Table table = small_table();
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
    Eigen::Matrix3d stored = table.stored_at(flat);
    stored.row(1).setZero();
    table.set_stored(flat, stored);
  }
  const QualityReport report = quick_report(table);
  EXPECT_EQ(report.queries_singular, 40u);
  EXPECT_EQ(report.area_light.count, 0u);
}

TEST(Quality, RefusesToJudgeByNothing) {
  QualitySettings settings = quick_settings();
  settings.query_directions = 0;
  EXPECT_THROW(measure_quality(small_table(), settings, {1}), InputError);
  settings = quick_settings();
  settings.quads = 0;
  EXPECT_THROW(measure_quality(small_table(), settings, {1}), InputError);
}

// The same nodes and queries, so that what differs is the error of judging each; how well 600
// queries stand for all is another matter, and stated as the standard error of their mean. The
// table has as many planes of alpha as the default: at alpha 0 the tails of the lobe are noisy.
TEST(Quality, LossesAgreeWithThoseOfTenTimesTheSamples) {
  Config config = load_config(std::nullopt, {});
  config.grid = Grid::paper({8, 2, 3, 2});
  config.refine.steps = 0;
  const Table table = generate_table(config, {2});
  QualitySettings settings;
  settings.queries = 20;
  settings.most_nodes = 48;
  settings.node_directions = settings.query_directions = 8;  // the same ones below
  settings.quad_samples = 64;
  const QualityReport report = measure_quality(table, settings, {2});
  settings.node_samples *= 10;
  settings.query_samples *= 10;
  const QualityReport finer = measure_quality(table, settings, {2});
  EXPECT_NEAR(report.nodes.mean / finer.nodes.mean, 1, 0.02);
  EXPECT_NEAR(report.query_losses.mean / finer.query_losses.mean, 1, 0.02);
  EXPECT_NEAR(report.floor_losses.mean / finer.floor_losses.mean, 1, 0.02);
}

// The area-light figures of 600 queries, as many as the default has, and no other figure.
QualityReport area_lights_of(std::size_t quads, std::size_t samples) {
  const Table& table = small_table();
  QualitySettings settings;
  settings.query_samples = 64;
  settings.query_directions = 4;
  settings.most_nodes = 0;
  settings.quads = quads;
  settings.quad_samples = samples;
  std::vector<QueryFloor> floors;
  for (const Lobe& lobe : random_queries(settings.range, 600, 1, table.grid.alpha_min)) {
    floors.emplace_back();
    floors.back().lobe = lobe;
  }
  return measure_quality(table, settings, floors, {2});
}

void expect_same_light(const QualityReport& report, const QualityReport& finer) {
  EXPECT_EQ(report.area_light.count, 600u);
  EXPECT_NEAR(report.area_light.mean / finer.area_light.mean, 1, 0.02);
  EXPECT_NEAR(report.area_light_with_amplitude.mean / finer.area_light_with_amplitude.mean, 1,
              0.02);
}

// With a sixteenth of the default's samples. Rectangles do not depend on them: what differs is the
// noise of GGX in each, below a fifth of the error, which moves the mean by less than 2 %.
TEST(Quality, AreaLightErrorsAgreeWithThoseOfTenTimesTheSamples) {
  expect_same_light(area_lights_of(64, 1024), area_lights_of(64, 10240));
}

// With the default's 64 a query: independent ones would move the mean of 600 queries by 0.6 %, and
// these are spread more evenly.
TEST(Quality, AreaLightErrorsAgreeWithThoseOfTenTimesTheRectangles) {
  expect_same_light(area_lights_of(64, 1024), area_lights_of(640, 1024));
}

// One lobe, asked for over and over: rectangles drawn once for all would give one error.
TEST(Quality, EveryQueryHasRectanglesOfItsOwn) {
  std::vector<QueryFloor> floors(3);
  for (QueryFloor& floor : floors)
    floor.lobe = {0.3, 0.1, 0.7, 0.6};
  const QualityReport report = measure_quality(small_table(), quick_settings(), floors, {1});
  EXPECT_NE(report.queries[0].area_light.mean_absolute, report.queries[1].area_light.mean_absolute);
  EXPECT_NE(report.queries[1].area_light.mean_absolute, report.queries[2].area_light.mean_absolute);
}

// Directions are drawn at random, 32 a lobe, which moves one lobe's relative loss by 5 to 10 %. The
// mean of 120 is then within 0.9 %; 2 % are 2.2 deviations, which the fixed seed keeps within.
TEST(Quality, FiguresAgreeWithThoseOfTenTimesTheDirections) {
  QualitySettings settings = quick_settings();
  settings.queries = settings.most_nodes = 120;
  settings.node_samples = settings.query_samples = 512;
  settings.node_directions = settings.query_directions = 32;
  const QualityReport report = measure_quality(small_table(), settings, {2});
  settings.node_directions = settings.query_directions = 320;
  const QualityReport finer = measure_quality(small_table(), settings, {2});
  EXPECT_NEAR(report.nodes.mean / finer.nodes.mean, 1, 0.02);
  EXPECT_NEAR(report.query_losses.mean / finer.query_losses.mean, 1, 0.02);
  EXPECT_NEAR(report.floor_losses.mean / finer.floor_losses.mean, 1, 0.02);
}

// Where an independent prototype found it with 600 queries of its own: 0.117, and the fits of the
// queries 0.060. Ours have a standard error of 5 %, so do those; 0.02 is 2.4 deviations of the
// difference, and as much as 600 more queries may move it.
TEST(Quality, ThePublishedTableIsAtTwiceTheFloor) {
  const std::filesystem::path file = test::reference_file("upstream_alpha_lambda_theta_phi.npy");
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << file << " is missing";
  QualitySettings settings;
  settings.query_samples = 4096;
  settings.query_directions = 16;
  settings.quad_samples = 4096;
  settings.most_nodes = 0;
  settings.floor_fit = FitSettings{};
  const QualityReport report = measure_quality(read_table(file), settings, {2});
  EXPECT_NEAR(report.query_losses.mean, 0.117, 0.02);
  EXPECT_NEAR(report.floor_losses.mean, 0.060, 0.01);
  EXPECT_NEAR(report.area_light.mean, 0.0230, 0.005);
  const std::vector<Band>& roughness = report.bands[0].bands;
  ASSERT_EQ(roughness.size(), 4u);
  // 70 queries in each of the first three bands, 8 to 10 % of standard error in either figure.
  const double expected[] = {0.337, 0.191, 0.112, 0.067};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(roughness[i].relative_loss / expected[i], 1, 0.25) << i;
}

}  // namespace
}  // namespace ltc
