// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Does one thing that a sanitizer must notice, built with the flags of everything else:
// planted_fault heap-overflow | signed-overflow | leak | data-race | openmp-race | none
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string_view>
#include <thread>

namespace {

// Values that no compiler knows beforehand, so that no fault is optimised away.
volatile int unknown_one = 1;

int read_beyond_the_heap() {
  const auto size = static_cast<std::size_t>(unknown_one);
  char* const bytes = new char[size];
  bytes[0] = 0;
  const int beyond = *const_cast<volatile char*>(bytes + size);
  delete[] bytes;
  return beyond;
}

int overflow() {
  return std::numeric_limits<int>::max() + unknown_one;
}

int leak() {
  static char* volatile forgotten = nullptr;
  forgotten = new char[100];
  forgotten = nullptr;
  return 0;
}

int race_of_threads() {
  int count = 0;
  const auto add = [&count] {
    for (int i = 0; i < 1000; ++i)
      count += unknown_one;
  };
  std::thread other(add);
  add();
  other.join();
  return count == 0;
}

int race_of_openmp() {
  int count = 0;
  std::atomic<int> arrived = 0;
#pragma omp parallel num_threads(2)
  {
    ++arrived;
    while (arrived.load(std::memory_order_relaxed) < 2)
      std::this_thread::yield();
    for (int i = 0; i < 1000; ++i)
      count += unknown_one;
  }
  return count == 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view fault = argc == 2 ? argv[1] : "";
  int result = 0;
  if (fault == "heap-overflow")
    result = read_beyond_the_heap();
  else if (fault == "signed-overflow")
    result = overflow();
  else if (fault == "leak")
    result = leak();
  else if (fault == "data-race")
    result = race_of_threads();
  else if (fault == "openmp-race")
    result = race_of_openmp();
  else if (fault != "none")
    return 2;
  std::printf("done %d\n", result);
  return 0;
}
