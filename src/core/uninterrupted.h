// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What must not be cut off: who would end the process waits for it.
#pragma once

#include <chrono>

namespace ltc {

// While any lives, the process is not ended because of an interrupt, however long that takes.
class Uninterrupted {
 public:
  Uninterrupted();
  ~Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;
};

// How work that was asked to end is getting on, for who would end it otherwise.
class EndOfWork {
 public:
  enum class State { under_way, uninterrupted, ended };

  // Waits for the end, at most so long.
  State wait(std::chrono::milliseconds time);
  // Whether nothing is uninterrupted and the end has not come; then nothing that is to be
  // uninterrupted begins any more.
  bool forestall();
  // From any thread: the end has come.
  void come();

 private:
  State state() const;  // with the mutex held

  bool ended_ = false;
};

}  // namespace ltc
