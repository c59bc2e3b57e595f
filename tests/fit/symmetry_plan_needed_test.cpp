// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/symmetry_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ltc {
namespace {

TEST(SymmetryPlanOfNeeded, OverAllEntriesItIsThePlanOfTheGrid) {
  const Grid grid = Grid::paper({4, 4, 3, 4});
  const auto all = plan_by_symmetry(grid, std::vector<bool>(grid.size(), true));
  const auto plan = plan_by_symmetry(grid);
  ASSERT_EQ(plan.size(), grid.size());
  for (std::size_t flat = 0; flat < plan.size(); ++flat) {
    EXPECT_EQ(all[flat].representative, plan[flat].representative);
    EXPECT_EQ(all[flat].turn_radians, plan[flat].turn_radians);
  }
}

TEST(SymmetryPlanOfNeeded, RepresentativesOfNeededEntriesAreNeeded) {
  const Grid grid = Grid::paper({4, 4, 3, 4});
  const auto whole = plan_by_symmetry(grid);
  std::mt19937 random(20260105);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<bool> needed(grid.size());
    std::generate(needed.begin(), needed.end(), [&] { return random() % 3 == 0; });
    const auto plan = plan_by_symmetry(grid, needed);
    for (std::size_t flat = 0; flat < plan.size(); ++flat) {
      const PlannedEntry& entry = plan[flat];
      if (!needed[flat]) {
        EXPECT_EQ(entry.representative, PlannedEntry::none);
        continue;
      }
      ASSERT_LE(entry.representative, flat);
      EXPECT_TRUE(needed[entry.representative]);
      EXPECT_EQ(plan[entry.representative].representative, entry.representative);
      EXPECT_EQ(plan[entry.representative].turn_radians, 0);
      // The same lobes are one, and lead to one another by the same turns, as in the whole plan.
      EXPECT_EQ(whole[entry.representative].representative, whole[flat].representative);
      EXPECT_NEAR(entry.turn_radians,
                  whole[flat].turn_radians - whole[entry.representative].turn_radians,
                  1e-15);  // one rounding of angles below 2
    }
  }
}

TEST(SymmetryPlanOfNeeded, WholeGridsFirstEqualNodeIsKnownWithoutAPlan) {
  const Grid grid = Grid::paper({3, 4, 3, 5});
  const EqualLobes equal(grid);
  const auto plan = plan_by_symmetry(grid);
  for (std::size_t flat = 0; flat < grid.size(); ++flat)
    EXPECT_EQ(equal.first_of(flat), plan[flat].representative) << flat;
  EXPECT_EQ(equal.count(), representative_count(plan));
  // alpha = 0 has one roughness whatever lambda, which is isotropic, as lambda = 1 is: three lobes
  // each. The other 2 x 3 have one from above and two of five azimuths.
  EXPECT_EQ(equal.count(), 3u * 3u + 2u * 3u * 11u);
}

}  // namespace
}  // namespace ltc
