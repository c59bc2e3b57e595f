// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/interrupt.h"

#include <fmt/format.h>

#include <chrono>
#include <string>

#include "cli/output.h"
#include "core/platform.h"
#include "pipeline/checkpoint_keeper.h"

namespace ltc::cli {
namespace {

// A signal handler reaches the run under way through this.
std::atomic<Progress*> interruptible{nullptr};

void stop_interruptible() {
  if (Progress* progress = interruptible.load())
    progress->request_stop();
}

// With work that could heed a request. Most of it looks every few milliseconds of its own time,
// which a busy machine may be slow to give.
class Patience {
 public:
  bool has_ended() const {
    using seconds = std::chrono::duration<double>;
    const double passed = seconds(Clock::now() - began_).count();
    const double used = platform::processor_seconds() - used_before_;
    return passed > longest_seconds || (passed > least_seconds && used > least_used_seconds);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double least_seconds = 0.4, least_used_seconds = 0.25, longest_seconds = 3;

  Clock::time_point began_ = Clock::now();
  double used_before_ = platform::processor_seconds();
};

}  // namespace

StopOnInterrupt::StopOnInterrupt(Progress& progress, bool speaks) : speaks_(speaks) {
  interruptible = &progress;
  platform::on_interrupt(stop_interruptible);
  watcher_ = std::thread([this] { watch(); });
}

StopOnInterrupt::~StopOnInterrupt() {
  interruptible = nullptr;
  closed_ = true;
  end_.come();
  platform::end_wait_for_interrupt();
  watcher_.join();
}

void StopOnInterrupt::set_checkpoint(const std::filesystem::path& file) {
  const std::lock_guard lock(mutex_);
  checkpoint_ = file;
}

void StopOnInterrupt::watch() {
  constexpr std::chrono::milliseconds turn{50};
  platform::wait_for_interrupt();
  Patience patience;
  while (!closed_) {
    const EndOfWork::State state = end_.wait(turn);
    if (state == EndOfWork::State::ended)
      return;
    if (state == EndOfWork::State::uninterrupted)
      patience = Patience();
    else if (patience.has_ended() && end_.forestall())
      end_process();
  }
}

void StopOnInterrupt::end_process() {
  const std::lock_guard lock(mutex_);
  const std::string way_on =
      with_way_on("interrupted, and ended in mid-work", checkpoint_, "--resume");
  platform::end_process(exit_code,
                        speaks_ ? fmt::format("ltcfit: {}\n", one_line(way_on)) : std::string());
}

}  // namespace ltc::cli
