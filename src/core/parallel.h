// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Independent work on all threads: progress, stops and exceptions handled in one place, the only
// one that knows OpenMP.
#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <string_view>

#include "core/run_context.h"

namespace ltc {

constexpr int most_threads = 1024;

// The processors that this process may use.
inline int processor_count() {
  return omp_get_num_procs();
}

// Calls work(i, state) for i from 0 on, below count and as long as go_on() holds, each thread with
// a state of its own from make_state(), as a part of a stage that is under way: nothing is counted.
// Returns how many of the first were done. `work` may write only to what belongs to i, so that the
// result does not depend on the number of threads. The first exception ends the work and is thrown
// again here; a stop that is asked for is thrown as Interrupted.
template <typename State, typename MakeState, typename Work, typename GoOn>
std::size_t parallel_while(std::size_t count, const RunContext& run, MakeState&& make_state,
                           Work&& work, GoOn&& go_on) {
  std::exception_ptr failure;
  std::mutex failure_mutex;
  std::atomic<bool> failed{false};
  std::atomic<std::size_t> next{0};
#pragma omp parallel num_threads(run.threads)
  {
    try {
      State state = make_state();
      // Taken one by one: entries differ in cost by far more than a counter does.
      while (!failed.load(std::memory_order_relaxed) && !run.stop_requested() && go_on()) {
        const std::size_t i = next.fetch_add(1, std::memory_order_relaxed);
        if (i >= count)
          break;
        work(i, state);
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure)
        failure = std::current_exception();
      failed = true;
    }
  }
  if (failure)
    std::rethrow_exception(failure);
  run.throw_if_stopped();
  return std::min(next.load(), count);
}

// The same for all i in [0, count).
template <typename State, typename MakeState, typename Work>
void parallel_for(std::size_t count, const RunContext& run, MakeState&& make_state, Work&& work) {
  parallel_while<State>(count, run, make_state, work, [] { return true; });
}

// As above, for work(i) that needs no state, is too short to be taken one by one and throws
// nothing.
template <typename Work>
void parallel_for(std::size_t count, const RunContext& run, Work&& work) {
#pragma omp parallel for num_threads(run.threads) schedule(static)
  for (std::size_t i = 0; i < count; ++i)
    if (!run.stop_requested())
      work(i);
  run.throw_if_stopped();
}

// As parallel_for, as a stage of its own, which counts.
template <typename State, typename MakeState, typename Work>
void parallel_for_each(std::string_view stage, std::size_t count, const RunContext& run,
                       MakeState&& make_state, Work&& work) {
  const Stage counted(run, stage, count);
  parallel_for<State>(count, run, make_state, [&](std::size_t i, State& state) {
    work(i, state);
    run.advance();
  });
}

// The same for work(i) that needs no state.
template <typename Work>
void parallel_for_each(std::string_view stage, std::size_t count, const RunContext& run,
                       Work&& work) {
  struct NoState {};
  parallel_for_each<NoState>(
      stage, count, run, [] { return NoState(); }, [&](std::size_t i, NoState&) { work(i); });
}

}  // namespace ltc
