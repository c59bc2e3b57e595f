// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/summary.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ltc {
namespace {

// Sixteen entries, all skipped.
Table small_table() {
  return Table::empty(Grid::paper(2), Storage::matrix);
}

TEST(TableSummary, OfNothingIsNoNumber) {
  const TableSummary summary = summarize(small_table(), 5);
  EXPECT_EQ(summary.entries_by_status, (std::array<std::size_t, 6>{16, 0, 0, 0, 0, 0}));
  EXPECT_EQ(summary.losses.count, 0u);
  EXPECT_TRUE(std::isnan(summary.losses.mean));
  EXPECT_TRUE(std::isnan(summary.losses.largest));
  EXPECT_TRUE(summary.worst.empty());
}

TEST(TableSummary, IgnoresEntriesWithoutALoss) {
  Table table = small_table();
  const auto set = [&](std::size_t entry, Status status, float loss) {
    table.status[entry] = status;
    table.sw_loss[entry] = loss;
  };
  set(3, Status::fitted, 0.25f);
  set(5, Status::copied, 0.5f);
  set(9, Status::analytic, 0.0f);
  set(12, Status::fitted, 0.25f);
  set(13, Status::failed, std::nanf(""));
  const TableSummary summary = summarize(table, 3);
  EXPECT_EQ(summary.entries_by_status, (std::array<std::size_t, 6>{11, 2, 1, 1, 1, 0}));
  EXPECT_EQ(summary.losses.count, 4u);
  EXPECT_EQ(summary.losses.mean, 0.25);  // exact: sums of powers of two
  EXPECT_EQ(summary.losses.largest, 0.5);
  EXPECT_EQ(summary.worst, (std::vector<std::size_t>{5, 3, 12}));
}

TEST(TableSummary, NamesEachLobeOnce) {
  Table table = small_table();
  // Entries 12 and 13 differ in phi alone, at theta = 0.
  for (const auto& [entry, loss] : {std::pair{12, 1.0f}, {13, 1.0f}, {10, 0.5f}})
    table.sw_loss[static_cast<std::size_t>(entry)] = loss;
  EXPECT_EQ(summarize(table, 5).worst, (std::vector<std::size_t>{12, 10}));
}

TEST(TableSummary, PercentileLeavesFivePercentAbove) {
  Table table = Table::empty(Grid::paper(5), Storage::matrix);  // 625 entries
  for (std::size_t i = 0; i < 100; ++i)
    table.sw_loss[i * 6] = static_cast<float>(i + 1);
  const TableSummary summary = summarize(table, 1);
  EXPECT_EQ(summary.losses.count, 100u);
  EXPECT_EQ(summary.losses.p95, 95);  // 96 … 100 are above
  EXPECT_EQ(summary.losses.mean, 50.5);
}

}  // namespace
}  // namespace ltc
