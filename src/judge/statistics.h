// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a list of figures adds up to.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace ltc {

// All NaN but for `count` where there is no value.
struct Statistics {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::size_t count = 0;
  double mean = none;
  double standard_error = none;  // of the mean, were the values drawn anew; of two values or more
  double p50 = none, p95 = none, p99 = none, largest = none;
  std::size_t largest_index = 0;  // into the list of values, those that are left out counted
};

// Of those values that are no NaN and that `include` is true for; of all where it is empty. pNN is
// the least value that at least NN % of the values do not exceed. An infinite value counts: leaving
// it out would make what is hopeless look good.
Statistics statistics_of(std::span<const double> values, const std::vector<bool>& include = {});

}  // namespace ltc
