// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a table's entries add up to: how many of which status, how large their losses.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "judge/statistics.h"
#include "table/table.h"

namespace ltc {

struct TableSummary {
  std::array<std::size_t, 6> entries_by_status{};  // indexed by Status
  Statistics losses;  // sliced-Wasserstein; of the entries with a finite one
  // Flat indices by falling loss, at most as many as asked for, each lobe once.
  std::vector<std::size_t> worst;
};

// Entries of equal loss stand in the order of the grid.
TableSummary summarize(const Table& table, std::size_t worst_count);

}  // namespace ltc
