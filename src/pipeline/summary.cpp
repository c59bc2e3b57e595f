// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/summary.h"

#include <algorithm>
#include <cmath>

#include "fit/symmetry_plan.h"

namespace ltc {

TableSummary summarize(const Table& table, std::size_t worst_count) {
  TableSummary summary;
  for (const Status status : table.status)
    ++summary.entries_by_status.at(static_cast<std::size_t>(status));

  std::vector<std::size_t> falling;
  double sum = 0;
  for (std::size_t i = 0; i < table.sw_loss.size(); ++i)
    if (std::isfinite(table.sw_loss[i])) {
      falling.push_back(i);
      sum += static_cast<double>(table.sw_loss[i]);
    }
  summary.judged = falling.size();
  if (falling.empty())
    return summary;

  std::stable_sort(falling.begin(), falling.end(), [&](std::size_t a, std::size_t b) {
    return table.sw_loss[a] > table.sw_loss[b];
  });
  const std::size_t above_p95 = falling.size() * 5 / 100;
  summary.mean_loss = sum / static_cast<double>(falling.size());
  summary.p95_loss = static_cast<double>(table.sw_loss[falling[above_p95]]);
  summary.largest_loss = static_cast<double>(table.sw_loss[falling.front()]);
  summary.worst = each_lobe_once(table.grid, falling);
  summary.worst.resize(std::min(summary.worst.size(), worst_count));
  return summary;
}

}  // namespace ltc
