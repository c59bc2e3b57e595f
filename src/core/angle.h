// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Degrees, as people write angles, to radians, as the library takes them.
#pragma once

#include <numbers>

namespace ltc {

inline constexpr double radians_per_degree = std::numbers::pi / 180;

// Everything that reads degrees goes through here: equal degrees are equal radians, bit for bit.
inline constexpr double radians_of_degrees(double degrees) {
  return degrees * radians_per_degree;
}

}  // namespace ltc
