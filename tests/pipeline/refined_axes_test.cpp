// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables on other axes than the paper's are refined for what they serve.
#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "core/error.h"
#include "judge/quality.h"
#include "pipeline/fit_one.h"
#include "pipeline/generate.h"
#include "support/refusal.h"
#include "table/query_range.h"

namespace ltc {
namespace {

Config config_on(const Grid& grid, int refine_steps) {
  Config config;
  config.grid = grid;
  config.refine.steps = refine_steps;
  config.fit.gauss_newton.samples = 1024;
  config.fit.gauss_newton.target_samples = 2048;
  return config;
}

// Judged on other queries and samples than those that the refinement knows.
QualitySettings effort_on(const Grid& grid) {
  QualitySettings settings;
  settings.range = query_range_of(grid, settings.range);
  settings.most_nodes = 0;
  settings.queries = 150;
  settings.query_samples = 2048;
  settings.query_directions = 16;
  settings.quads = 1;
  settings.quad_samples = 64;
  settings.floor_fit.gauss_newton.starts = 1;
  return settings;
}

// `share` is what refinement leaves of the error, `over_floor` how far that is above an LTC of each
// lobe's own; bounds are a tenth above what was measured.
void expect_refined_to_be_better(const Grid& grid, double share, double over_floor) {
  GenerateReport report;
  const QualitySettings effort = effort_on(grid);
  const std::vector<QueryFloor> floors = fit_queries(effort, grid, {2});
  const auto quality_of = [&](int refine_steps) {
    const Table table = generate_table(config_on(grid, refine_steps), {2}, &report);
    return measure_quality(table, effort, floors, {2});
  };
  const QualityReport plain = quality_of(0), refined = quality_of(6);
  EXPECT_TRUE(report.refine->kept);
  EXPECT_TRUE(report.range_served);
  EXPECT_EQ(refined.queries_outside, 0u);
  EXPECT_EQ(plain.query_losses.count, 150u);
  EXPECT_EQ(refined.query_losses.count, 150u);
  EXPECT_LT(refined.query_losses.mean, share * plain.query_losses.mean);
  EXPECT_LT(refined.query_losses.mean, over_floor * refined.floor_losses.mean);
}

TEST(RefinedAxes, RoughnessOfAPartOfTheRange) {
  Grid grid = Grid::paper({6, 5, 5, 4});
  grid.alpha = Axis::make(0.05, 0.6, 6, Warp::linear);
  expect_refined_to_be_better(grid, 0.6, 1.7);
}

TEST(RefinedAxes, AnIsotropicTable) {
  Grid grid = Grid::paper({8, 1, 8, 1});
  grid.lambda = Axis::make(1, 1, 1, Warp::linear);
  expect_refined_to_be_better(grid, 0.83, 1.86);
}

// Its fit used to end with a column of 1e-7, by a step through zero, and a condition number of 1e7.
TEST(RefinedAxes, NoColumnOfAThinLobesFitVanishes) {
  const double theta = Grid::paper().theta.nodes[5];
  const LobeFit fit = fit_lobe(Config{}, {0.6, 1e-4, theta, 0}, 1, std::nullopt);
  const Eigen::Vector3d singular = Eigen::JacobiSVD<Eigen::Matrix3d>(fit.matrix).singularValues();
  EXPECT_LT(singular[0] / singular[2], 5.01e6);  // the bound, and rounding to floats
  EXPECT_LT(fit.held_out_loss, 0.01 * fit.spread);
}

TEST(RefinedAxes, WhatNeedsMoreMemoryThanThereIsIsRefusedBeforeTheWork) {
  Config config = config_on(Grid::paper(16), 1);
  require_memory(config, std::vector<bool>(config.grid.size(), true));
  config.refine.queries_per_cell = 1000;
  config.refine.sampling.directions = 4096;
  // 50,625 cells, each of 1,000 queries that keep a megabyte.
  const std::string message = test::message_of<InputError>(
      [&] { require_memory(config, std::vector<bool>(config.grid.size(), true)); });
  test::expect_one_line(message, {"refining a table of 65536 entries", "e+04 GB", "are available",
                                  "refine.queries_per_cell (here 1000)", "refine.steps = 0"});
}

}  // namespace
}  // namespace ltc
