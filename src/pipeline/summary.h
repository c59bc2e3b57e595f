// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a table's entries add up to: how many of which status, how large their losses.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "table/table.h"

namespace ltc {

struct TableSummary {
  std::array<std::size_t, 5> entries_by_status{};  // indexed by Status
  std::size_t judged = 0;  // entries with a finite loss; the rest count nowhere below
  double mean_loss = 0;    // sliced-Wasserstein; all 0 if nothing was judged
  double p95_loss = 0;     // the least loss that 95 % of the judged do not exceed
  double largest_loss = 0;
  // Flat indices by falling loss, at most as many as asked for, each lobe once.
  std::vector<std::size_t> worst;
};

// Entries of equal loss stand in the order of the grid.
TableSummary summarize(const Table& table, std::size_t worst_count);

}  // namespace ltc
