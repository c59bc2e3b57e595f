// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Ctrl-C asks the run under way to stop.
#pragma once

#include "core/progress.h"

namespace ltc::cli {

// While it lives, an interrupt asks `progress` to stop. One at a time.
class StopOnInterrupt {
 public:
  explicit StopOnInterrupt(Progress& progress);
  ~StopOnInterrupt();
  StopOnInterrupt(const StopOnInterrupt&) = delete;
  StopOnInterrupt& operator=(const StopOnInterrupt&) = delete;
};

}  // namespace ltc::cli
