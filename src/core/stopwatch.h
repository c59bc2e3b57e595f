// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How long something took, by a clock that never goes back.
#pragma once

#include <chrono>

namespace ltc {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace ltc
