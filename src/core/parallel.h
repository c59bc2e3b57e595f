// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Independent work on all threads: progress, stops and exceptions handled in one place.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <string_view>

#include "core/progress.h"

namespace ltc {

// Calls work(i, state) for i in [0, count), each thread with a state of its own from make_state().
// `work` may write only to what belongs to i, so that the result does not depend on the number of
// threads. The first exception ends the work and is thrown again here; a stop that `progress`
// (which may be null) asks for is thrown as Interrupted.
template <typename State, typename MakeState, typename Work>
void parallel_for_each(std::string_view stage, std::size_t count, int threads, Progress* progress,
                       MakeState&& make_state, Work&& work) {
  std::exception_ptr failure;
  std::mutex failure_mutex;
  std::atomic<bool> failed{false};
  std::atomic<std::size_t> next{0};
  if (progress)
    progress->begin_stage(stage, count);
#pragma omp parallel num_threads(threads)
  {
    try {
      State state = make_state();
      // Taken one by one: entries differ in cost by far more than a counter does.
      for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) {
        if (failed.load(std::memory_order_relaxed) || (progress && progress->stop_requested()))
          break;
        work(i, state);
        if (progress)
          progress->advance();
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure)
        failure = std::current_exception();
      failed = true;
    }
  }
  if (progress)
    progress->end_stage();
  if (failure)
    std::rethrow_exception(failure);
  if (progress)
    progress->throw_if_stopped();
}

// Calls work(i) for i in [0, count) as a part of a stage that is under way: nothing is counted, and
// `work` is too short to be taken one by one and throws nothing. Throws Interrupted as above.
template <typename Work>
void parallel_for(std::size_t count, int threads, const Progress* progress, Work&& work) {
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::size_t i = 0; i < count; ++i)
    if (!(progress && progress->stop_requested()))
      work(i);
  if (progress)
    progress->throw_if_stopped();
}

// As parallel_for_each, for work(i) that needs no state.
template <typename Work>
void parallel_for_each(std::string_view stage, std::size_t count, int threads, Progress* progress,
                       Work&& work) {
  struct NoState {};
  parallel_for_each<NoState>(
      stage, count, threads, progress, [] { return NoState(); },
      [&](std::size_t i, NoState&) { work(i); });
}

}  // namespace ltc
