// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Shows progress on standard error: a bar on a terminal, a line now and then elsewhere.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "core/progress.h"

namespace ltc::cli {

// Workers only count (Progress::advance); one thread of its own draws, and sleeps in between.
class ProgressDisplay final : public Progress {
 public:
  ProgressDisplay();
  ~ProgressDisplay() override;  // erases a bar that is still there

  void begin_stage(std::string_view name, std::size_t total) override;
  void end_stage() override;

 private:
  using Clock = std::chrono::steady_clock;

  void draw_until_closed();
  void draw();       // with the mutex held
  void erase_bar();  // likewise

  const bool on_terminal_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::string stage_;  // empty between stages
  std::size_t total_ = 0;
  Clock::time_point stage_began_, next_line_;
  bool bar_visible_ = false;
  bool closed_ = false;
  std::thread drawer_;  // started with the first stage
};

// The texts of a stage under way: "fit  [=====>    ]  50 %  2048/4096  512/s  4 s left", cut to
// `columns`, and "fit: 2048 of 4096, 512/s, 4 s left".
struct StageState {
  std::string_view name;
  std::size_t done = 0, total = 0;
  double seconds = 0;  // since it began
};
std::string bar_text(const StageState& state, std::size_t columns);
std::string line_text(const StageState& state);

// "0.42 s", "12.3 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace ltc::cli
