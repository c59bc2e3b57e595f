// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Quantiles of a list of values.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ltc {

// The least of the values, sorted ascending and at least one, that a `share` of them in [0, 1] does
// not exceed.
inline double quantile(const std::vector<double>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::min(rank == 0 ? 0 : rank - 1, sorted.size() - 1)];
}

}  // namespace ltc
