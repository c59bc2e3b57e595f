// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Two tables, lobe against lobe: which is nearer to GGX, and by how much.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "table/table.h"

namespace ltc {

struct CompareSettings {
  std::size_t samples = 16384;  // weighted lattice samples of the lobe, and cosine samples
  std::size_t directions = 64;  // random projection directions
  std::uint64_t seed = 20220712;
};

// One entry of both tables. Losses are held out: sliced-Wasserstein distances to the GGX lobe on
// samples and directions that no fit has seen. NaN where a table has no matrix.
struct EntryComparison {
  double loss_a = 0, loss_b = 0;
  double spread = 0;  // of the GGX lobe, the scale that losses are judged by
};

// Throws InputError, naming the difference, unless the two grids are the same.
void require_same_grid(const Grid& a, const Grid& b);

// One comparison a node. Throws InputError when the grids differ.
std::vector<EntryComparison> compare_tables(const Table& a, const Table& b,
                                            const CompareSettings& settings, int threads,
                                            Progress* progress);

// Statistics of the ratio loss_a / loss_b over the entries that both tables have.
struct RatioSummary {
  std::size_t entries = 0;
  double mean = 0, p50 = 0, p95 = 0, p99 = 0, largest = 0;
  double mean_loss_a = 0, mean_loss_b = 0;
  std::size_t largest_entry = 0;  // flat index
};
// Over the entries `include` is true for; all where it is empty.
RatioSummary summarize_ratios(const std::vector<EntryComparison>& entries,
                              const std::vector<bool>& include = {});

}  // namespace ltc
