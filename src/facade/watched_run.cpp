// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "facade/watched_run.h"

#include <fmt/format.h>

#include <chrono>
#include <future>
#include <mutex>
#include <string>

#include "core/error.h"
#include "core/parallel.h"

namespace ltcfit {
namespace {

constexpr std::chrono::milliseconds between_calls{100};

// What the worker says of its stages, for the thread that watches to read.
class Stages final : public ltc::Progress {
 public:
  void begin_stage(std::string_view name, std::size_t total) override {
    const std::lock_guard lock(mutex_);
    name_ = name;
    total_ = total;
    reset_done();
  }
  void end_stage() override {}

  bool tell(const decltype(Run::progress)& watcher) const {
    std::unique_lock lock(mutex_);
    const std::string name = name_;
    const std::size_t finished = done(), total = total_;
    lock.unlock();
    return watcher(name, finished, total);
  }

 private:
  mutable std::mutex mutex_;
  std::string name_;
  std::size_t total_ = 0;
};

int thread_count(const Run& run) {
  if (run.threads < 0 || run.threads > ltc::most_threads)
    throw InputError(
        fmt::format("threads is {}; allowed: a whole number in [1, {}], or 0 for one a processor",
                    run.threads, ltc::most_threads));
  return run.threads == 0 ? ltc::processor_count() : run.threads;
}

}  // namespace

void do_watched(const Run& run, const std::function<void(const ltc::RunContext&)>& work) {
  const int threads = thread_count(run);
  if (!run.progress)
    return work({threads});
  Stages stages;
  std::future<void> worker = std::async(std::launch::async, [&] { work({threads, &stages}); });
  try {
    while (worker.wait_for(between_calls) != std::future_status::ready)
      if (!stages.tell(run.progress))
        stages.request_stop();
  } catch (...) {
    stages.request_stop();
    worker.wait();
    throw;
  }
  worker.get();
}

}  // namespace ltcfit
