// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/interrupt.h"

#include <atomic>

#include "core/platform.h"

namespace ltc::cli {
namespace {

// A signal handler reaches the run under way through this.
std::atomic<Progress*> interruptible{nullptr};

void stop_interruptible() {
  if (Progress* progress = interruptible.load())
    progress->request_stop();
}

}  // namespace

StopOnInterrupt::StopOnInterrupt(Progress& progress) {
  interruptible = &progress;
  platform::on_interrupt(stop_interruptible);
}

StopOnInterrupt::~StopOnInterrupt() {
  interruptible = nullptr;
}

}  // namespace ltc::cli
