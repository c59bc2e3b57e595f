// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/uninterrupted.h"

#include <condition_variable>
#include <mutex>

namespace ltc {
namespace {

// Of the process: what one part of it must finish, another must not cut off.
std::mutex mutex;
std::condition_variable changed;
int alive = 0;
bool over = false;

}  // namespace

Uninterrupted::Uninterrupted() {
  std::unique_lock lock(mutex);
  changed.wait(lock, [] { return !over; });
  ++alive;
}

Uninterrupted::~Uninterrupted() {
  const std::lock_guard lock(mutex);
  --alive;
  changed.notify_all();
}

EndOfWork::State EndOfWork::state() const {
  return ended_ ? State::ended : alive > 0 ? State::uninterrupted : State::under_way;
}

EndOfWork::State EndOfWork::wait(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex);
  changed.wait_for(lock, time, [this] { return ended_; });
  return state();
}

bool EndOfWork::forestall() {
  const std::lock_guard lock(mutex);
  return over = state() == State::under_way;
}

void EndOfWork::come() {
  const std::lock_guard lock(mutex);
  ended_ = true;
  changed.notify_all();
}

}  // namespace ltc
