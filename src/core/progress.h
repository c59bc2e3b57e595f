// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How long work reports how far it is and learns that it should stop.
#pragma once

#include <atomic>
#include <cstddef>
#include <string_view>

#include "core/error.h"

namespace ltc {

// Shared by the workers of one stage and whoever watches them. Workers only add to an atomic
// counter; drawing is the watcher's business.
class Progress {
 public:
  virtual ~Progress() = default;

  // A stage begins: `name` as a person would read it ("fit"), `total` units of work.
  virtual void begin_stage(std::string_view name, std::size_t total) = 0;
  virtual void end_stage() = 0;

  // From any thread: `count` more units are done.
  void advance(std::size_t count = 1) { done_.fetch_add(count, std::memory_order_relaxed); }
  std::size_t done() const { return done_.load(std::memory_order_relaxed); }

  // From a signal handler or any thread: ends the work at the next opportunity.
  void request_stop() { stop_.store(true, std::memory_order_relaxed); }
  bool stop_requested() const { return stop_.load(std::memory_order_relaxed); }

  // Throws Interrupted once a stop was requested. Not from inside a parallel region.
  void throw_if_stopped() const {
    if (stop_requested())
      throw Interrupted();
  }

 protected:
  void reset_done() { done_.store(0, std::memory_order_relaxed); }

 private:
  std::atomic<std::size_t> done_{0};
  std::atomic<bool> stop_{false};
};

// Nobody watches; only the wish to stop matters.
class StopOnly final : public Progress {
 public:
  void begin_stage(std::string_view, std::size_t) override { reset_done(); }
  void end_stage() override {}
};

}  // namespace ltc
