// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/cost_text.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fit/symmetry_plan.h"

namespace ltc::cli {
namespace {

Config with_nodes(std::size_t nodes, int refine_steps) {
  Config config;
  config.grid = Grid::paper(nodes);
  config.refine.steps = refine_steps;
  return config;
}

Cost cost_of_whole(const Config& config) {
  return cost_of(config, std::vector<bool>(config.grid.size(), true));
}

TEST(Cost, CountsEveryLobeOnce) {
  const Config config = with_nodes(6, 0);
  const Cost whole = cost_of_whole(config);
  EXPECT_EQ(whole.fits, representative_count(plan_by_symmetry(config.grid)));
  EXPECT_EQ(whole.queries, 0u);
  std::vector<bool> half(config.grid.size());
  std::fill_n(half.begin(), half.size() / 2, true);
  const Cost part = cost_of(config, half);
  EXPECT_EQ(part.fits, representative_count(plan_by_symmetry(config.grid, half)));
  EXPECT_LT(part.fits, whole.fits);
}

TEST(Cost, RefinementCostsMore) {
  const Cost without = cost_of_whole(with_nodes(6, 0)), with = cost_of_whole(with_nodes(6, 5));
  EXPECT_GT(with.queries, 0u);
  EXPECT_GT(with.memory_bytes, without.memory_bytes);
}

// 16,384 fits or so are told, with files of 12 + 12 + 9 floats and three bytes an entry.
TEST(Cost, IsSaidOfLongRunsAlone) {
  const Config quick = with_nodes(8, 5);
  Config slow = with_nodes(16, 0);
  EXPECT_NE(cost_text(slow, cost_of_whole(slow)).find("the others interpolated; "),
            std::string::npos);
  slow.fit.interpolation = InterpolationMode::off;
  EXPECT_EQ(cost_text(quick, cost_of_whole(quick)), "");
  const Cost cost = cost_of_whole(slow);
  const std::string text = cost_text(slow, cost);
  EXPECT_TRUE(
      text.starts_with("generate: " + std::to_string(cost.fits) + " fits for 65536 entries; "))
      << text;
  EXPECT_TRUE(text.ends_with(" of memory and 0.0088 GB of files\n")) << text;
}

}  // namespace
}  // namespace ltc::cli
