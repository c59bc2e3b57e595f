// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Ctrl-C asks the run under way to stop, and ends it where it does not.
#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <thread>

#include "core/progress.h"
#include "core/uninterrupted.h"

namespace ltc::cli {

// While it lives, an interrupt asks `progress` to stop. If it still lives half a second later, it
// ends the process with exit_code: work that fills gigabytes, or a library's, hears of no request.
// A process that the machine gave no time to has some more. What is Uninterrupted, files that take
// their places and a checkpoint that is brought up to date, is waited for, and what follows it has
// the same time anew. One at a time.
class StopOnInterrupt {
 public:
  static constexpr int exit_code = 130;

  // Of several ranks one `speaks` of a process that is ended.
  explicit StopOnInterrupt(Progress& progress, bool speaks = true);
  ~StopOnInterrupt();
  StopOnInterrupt(const StopOnInterrupt&) = delete;
  StopOnInterrupt& operator=(const StopOnInterrupt&) = delete;

  // Named in the last message of a process that is ended, if there is such a file then.
  void set_checkpoint(const std::filesystem::path& file);

 private:
  void watch();
  [[noreturn]] void end_process();

  EndOfWork end_;
  const bool speaks_;
  std::atomic<bool> closed_{false};
  std::mutex mutex_;
  std::filesystem::path checkpoint_;
  std::thread watcher_;
};

}  // namespace ltc::cli
