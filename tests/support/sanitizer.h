// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Whether the tests and the program are built with a sanitizer.
#pragma once

#include <string_view>

namespace ltc::test {

// A sanitizer's own memory (shadow, quarantine, red zones) counts as the process's: bounds on the
// memory of the program say nothing there.
#ifdef LTCFIT_SANITIZERS
inline constexpr bool under_sanitizer = true;
inline constexpr bool under_thread_sanitizer = std::string_view(LTCFIT_SANITIZERS) == "thread";
#else
inline constexpr bool under_sanitizer = false;
inline constexpr bool under_thread_sanitizer = false;
#endif

}  // namespace ltc::test
