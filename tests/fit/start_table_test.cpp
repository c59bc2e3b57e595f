// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/start_table.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "config/config.h"
#include "fit/lobe_frame.h"
#include "judge/held_out.h"

namespace ltc {
namespace {

Grid small_grid() {
  const std::vector<std::string> changes = {"table.alpha.nodes=3", "table.lambda.nodes=3",
                                            "table.theta.nodes=3", "table.phi.nodes=3"};
  return load_config(std::nullopt, changes).grid;
}

TEST(StartTable, EveryEntryIsNearItsLobe) {
  const Grid grid = small_grid();
  const std::vector<PlannedEntry> plan = plan_by_symmetry(grid);
  const std::vector<FittedEntry> entries = start_table(grid, plan, {2});
  HeldOutJudge judge(4096, 32);
  int analytic = 0, fitted = 0, copied = 0;
  for (std::size_t flat = 0; flat < entries.size(); ++flat) {
    const FittedEntry& entry = entries[flat];
    EXPECT_GT(entry.matrix.determinant(), 0) << flat;
    EXPECT_TRUE(std::isnan(entry.loss));
    analytic += entry.status == Status::analytic;
    fitted += entry.status == Status::fitted;
    copied += entry.status == Status::copied;
    // Thin ones start ten times too wide; mirrors at the horizon a little off their own width.
    if (grid.lambda.nodes[grid.node(flat).lambda] < 0.5)
      continue;
    judge.set_lobe(grid.lobe(flat));
    EXPECT_LT(judge.loss({entry.matrix}), 1.2 * judge.spread()) << flat;
  }
  EXPECT_GT(analytic, 0);
  EXPECT_GT(fitted, 20);
  EXPECT_GT(copied, 10);
}

TEST(StartTable, ThreadsAndNeedsMakeNoDifference) {
  const Grid grid = small_grid();
  std::vector<bool> needed(grid.size());
  const std::size_t one = grid.flat({1, 2, 1, 1});
  needed[one] = true;
  const std::vector<FittedEntry> all = start_table(grid, plan_by_symmetry(grid), {1});
  const std::vector<FittedEntry> threads = start_table(grid, plan_by_symmetry(grid), {3});
  for (std::size_t flat = 0; flat < all.size(); ++flat)
    EXPECT_EQ(all[flat].matrix, threads[flat].matrix);
  const std::vector<FittedEntry> some = start_table(grid, plan_by_symmetry(grid, needed), {1});
  EXPECT_EQ(some[one].status, Status::fitted);
  EXPECT_EQ(some[grid.flat({0, 0, 0, 0})].status, Status::skipped);
}

}  // namespace
}  // namespace ltc
