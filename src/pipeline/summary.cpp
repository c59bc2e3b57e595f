// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/summary.h"

#include <algorithm>
#include <cmath>

#include "fit/symmetry_plan.h"
#include "judge/comparison_summary.h"

namespace ltc {

TableSummary summarize(const Table& table, std::size_t worst_count) {
  TableSummary summary;
  for (const Status status : table.status)
    ++summary.entries_by_status.at(static_cast<std::size_t>(status));

  std::vector<double> losses(table.sw_loss.begin(), table.sw_loss.end());
  for (double& loss : losses)
    if (!std::isfinite(loss))
      loss = Statistics::none;
  summary.losses = statistics_of(losses);
  summary.worst = each_lobe_once(table.grid, largest_of(losses, losses.size()));
  summary.worst.resize(std::min(summary.worst.size(), worst_count));
  return summary;
}

}  // namespace ltc
