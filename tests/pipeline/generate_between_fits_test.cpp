// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Which tables are interpolated between fits (interpolate/between_fits.h).
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "config/config.h"
#include "pipeline/generate.h"

namespace ltc {
namespace {

bool interpolated(std::vector<std::string> overrides, std::size_t nodes = 16,
                  bool all_needed = true) {
  for (const char* axis : {"alpha", "lambda", "theta", "phi"})
    overrides.insert(overrides.begin(),
                     "table." + std::string(axis) + ".nodes=" + std::to_string(nodes));
  overrides.insert(overrides.begin(), "refine.steps=0");
  const Config config = load_config(std::nullopt, overrides);
  std::vector<bool> needed(config.grid.size(), true);
  needed[5] = all_needed;
  return is_interpolated(config, needed);
}

TEST(InterpolatedTables, AreBigOnesWithoutRefinement) {
  EXPECT_TRUE(interpolated({}));
  EXPECT_TRUE(interpolated({"table.storage=mirror-frame"}));
  EXPECT_FALSE(interpolated({}, 8));
  EXPECT_FALSE(interpolated({}, 12));
  EXPECT_FALSE(interpolated({"table.alpha.nodes=3", "table.lambda.nodes=3"}));
  EXPECT_FALSE(is_interpolated(load_config(std::nullopt, {}), std::vector<bool>(4096, true)));
}

TEST(InterpolatedTables, AreNotThoseThatItDoesNotServe) {
  for (const char* override :
       {"fit.interpolation=off", "refine.steps=1", "fit.solver=sgd", "fit.solver=l3-nelder-mead",
        "fit.horizon=scaled", "fit.gauss_newton.neighbour_sweeps=1", "field.size=600",
        "fit.lobe=folded"})
    EXPECT_FALSE(interpolated({override})) << override;
}

// An entry is the same whatever else is needed: of a part of the table each is fitted.
TEST(InterpolatedTables, AreWhole) {
  EXPECT_FALSE(interpolated({}, 16, false));
}

}  // namespace
}  // namespace ltc
