// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What making a table costs, told before it is made.
#pragma once

#include <cstddef>
#include <vector>

#include "config/config.h"
#include "table/query_range.h"
#include "table/table.h"

namespace ltc {

// What a refinement goes by beside the config.
struct RefineContext {
  std::vector<QueryRange> asked;    // what it serves; the config's range where there are none
  const Table* existing = nullptr;  // a table of the same grid that is extended: its entries take
                                    // part in look-ups and stay as they are

  // Whether that table has values at a node.
  bool has_existing(std::size_t flat) const {
    return existing && has_values(existing->status[flat]);
  }
};

// Whether the table is made by interpolate/between_fits.h: all of it, unrefined, by a plain
// Gauss-Newton fit, with more than 20,000 lobes and a long axis.
bool is_interpolated(const Config& config, const std::vector<bool>& needed);

struct Cost {
  std::size_t fits = 0;
  bool interpolated = false;     // fits are about so many, and lie at some of the nodes
  std::size_t memory_bytes = 0;  // about
  std::size_t queries = 0;       // look-ups that nodes are refined on; 0: no refinement
};
Cost cost_of(const Config& config, const std::vector<bool>& needed,
             const RefineContext& context = {});

// Throws InputError, with what is needed and what there is, where making the table would take more
// memory than is available: so many times, by the ranks on this machine.
void require_memory(const Config& config, const std::vector<bool>& needed,
                    const RefineContext& context = {}, int ranks_here = 1);

}  // namespace ltc
