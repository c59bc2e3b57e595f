// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// With what long work is done and who watches it, in one object that travels with it.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/progress.h"

namespace ltc {

class Ranks;  // core/ranks.h

struct RunContext {
  int threads = 1;               // at least 1; results have the same bits for any number
  Progress* progress = nullptr;  // null: nobody watches, and nobody asks for a stop
  Ranks* ranks = nullptr;        // who shares the work; null: this process alone. Never of less
                                 // than the whole run: all ranks have to come to the same places

  bool stop_requested() const { return progress && progress->stop_requested(); }
  // Throws Interrupted once a stop was requested. Not from inside a parallel region.
  void throw_if_stopped() const {
    if (progress)
      progress->throw_if_stopped();
  }
  void advance(std::size_t count = 1) const {
    if (progress)
      progress->advance(count);
  }
};

// A stage of the work, for as long as it lives.
class Stage {
 public:
  Stage(const RunContext& run, std::string_view name, std::size_t total) : progress_(run.progress) {
    if (progress_)
      progress_->begin_stage(name, total);
  }
  ~Stage() {
    if (progress_)
      progress_->end_stage();
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

 private:
  Progress* const progress_;
};

}  // namespace ltc
