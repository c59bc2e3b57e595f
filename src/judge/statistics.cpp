// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/quantile.h"

namespace ltc {

Statistics statistics_of(std::span<const double> values, const std::vector<bool>& include) {
  Statistics result;
  std::vector<double> sorted;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i]) || !(include.empty() || include[i]))
      continue;
    if (sorted.empty() || values[i] > values[result.largest_index])
      result.largest_index = i;
    sorted.push_back(values[i]);
  }
  if (sorted.empty())
    return result;
  result.count = sorted.size();
  const auto count = static_cast<double>(sorted.size());
  result.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / count;
  double squares = 0;
  for (const double value : sorted)
    squares += (value - result.mean) * (value - result.mean);
  if (sorted.size() > 1)
    result.standard_error = std::sqrt(squares / (count - 1) / count);
  std::sort(sorted.begin(), sorted.end());
  result.p50 = quantile(sorted, 0.5);
  result.p95 = quantile(sorted, 0.95);
  result.p99 = quantile(sorted, 0.99);
  result.largest = sorted.back();
  return result;
}

}  // namespace ltc
