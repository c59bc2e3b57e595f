// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the invariants measure in the lobes of a table: whether each is as near to GGX as the table
// says, and whether it jumps between nodes where GGX does not.
#pragma once

#include <cstddef>
#include <vector>

#include "core/run_context.h"
#include "table/table.h"

namespace ltc {

struct LobeEffort {
  std::size_t samples = 0;       // of a lobe
  std::size_t directions = 0;    // that they are projected on
  double suspicious_jump = 1.3;  // above it, neighbours are compared past an entry (jump_blame.h)
  double slack = 0;              // distance between lobes that is no jump at all
};

// One value an entry; NaN for entries that are not judged. Distances are those of LobeQuantiles,
// `spread` its spread of the GGX lobe.
struct LobeMeasures {
  // The distance of LTC and GGX over the stored loss plus a three-hundredth of the spread, which is
  // what the sample sets differ by. At most 1 for a loss that is right, but for noise.
  std::vector<double> loss_excess;

  // With d the distance of the LTCs of two adjacent nodes and g that of their GGX lobes, a jump is
  // d less the slack over g plus three hundredths of the smaller spread; adjacent along one axis,
  // one node apart.
  // Each jump is counted to one of the two (jump_blame.h); an entry's value is the largest that is
  // counted to it, 0 if none is.
  std::vector<double> neighbour_excess;
};

// Over the entries `judged` is true for, whose matrices must be finite. Throws Interrupted.
LobeMeasures measure_lobes(const Table& table, const std::vector<bool>& judged,
                           const LobeEffort& effort, const RunContext& run);

}  // namespace ltc
