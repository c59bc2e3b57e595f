// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/jump_blame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

namespace ltc {
namespace {

// Entries with a height each; a jump is the difference of two heights. One axis is enough to see
// what is compared with what.
struct Row {
  Grid grid;
  std::vector<double> heights;
  std::size_t asked = 0;  // how often a jump past an entry was wanted

  explicit Row(std::vector<double> of) : grid(Grid::paper({1, 1, 1, of.size()})), heights(of) {}

  double jump(std::size_t a, std::size_t b) const { return std::abs(heights[a] - heights[b]); }

  std::vector<double> blame(double suspicious, std::set<std::size_t> unjudged = {}) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> jumps(4 * heights.size(), nan);
    for (std::size_t i = 1; i < heights.size(); ++i)
      if (!unjudged.contains(i) && !unjudged.contains(i - 1))
        jumps[4 * i + 3] = static_cast<float>(jump(i - 1, i));
    return blame_jumps(grid, jumps, suspicious, [&](std::size_t a, std::size_t b) {
      ++asked;
      return jump(a, b);
    });
  }
};

using Values = std::vector<double>;

TEST(JumpBlame, OneThatJumpsIsNamedAndNotItsNeighbours) {
  Row row({0, 0, 5, 0, 0});
  EXPECT_EQ(row.blame(1), (Values{0, 0, 5, 0, 0}));
  EXPECT_EQ(row.asked, 1u);  // 1 and 3, past 2
}

TEST(JumpBlame, TwoThatAreAdjacentAreBothNamed) {
  // The lower one hides behind the higher: without it, it jumps to the sound entry beyond.
  EXPECT_EQ(Row({0, 0, 9, 7, 0, 0}).blame(1), (Values{0, 0, 9, 7, 0, 0}));
}

// Behind the largest jump the next smaller is alone at the end of the row: seen past the other.
TEST(JumpBlame, WhatIsLeftIsComparedPastWhatIsPutAside) {
  Row row({3, 9, 0, 0, 0});
  EXPECT_EQ(row.blame(1), (Values{3, 9, 0, 0, 0}));
  // Not past one whose jump is none.
  Row smooth({3, 9, 0, 0, 0});
  EXPECT_EQ(smooth.blame(100), (Values{0, 9, 0, 0, 0}));
  EXPECT_EQ(smooth.asked, 0u);
}

TEST(JumpBlame, WhatIsNotJudgedIsNotComparedPast) {
  Row row({9, 0, 0, 0, 9});
  const Values values = row.blame(1, {1, 3});
  for (const double value : values)
    EXPECT_TRUE(std::isnan(value));
  EXPECT_EQ(row.asked, 0u);
}

}  // namespace
}  // namespace ltc
