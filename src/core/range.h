// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The numbers that are allowed somewhere, and how messages say so.
#pragma once

#include <fmt/format.h>

#include <string>

namespace ltc {

// What a setting takes for a limit that excludes nothing finite.
inline constexpr double no_limit = 1e300;

// [least, most], without `least` itself if `above_least`, likewise `below_most`.
struct Range {
  double least, most;
  bool above_least = false, below_most = false;

  bool contains(double value) const {  // false for NaN
    return (above_least ? value > least : value >= least) &&
           (below_most ? value < most : value <= most);
  }
  std::string text() const {
    return fmt::format("{}{}, {}{}", above_least ? '(' : '[', least, most, below_most ? ')' : ']');
  }
};
inline constexpr Range above(double least, double most) {
  return {least, most, true, false};
}
inline constexpr Range below(double least, double most) {
  return {least, most, false, true};
}

}  // namespace ltc
