// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Ranks that are threads of this process.
#pragma once

#include <algorithm>
#include <barrier>
#include <cstddef>
#include <functional>
#include <span>
#include <thread>
#include <vector>

#include "core/ranks.h"

namespace ltc::test {

// What they speak through.
class FakeWorld {
 public:
  explicit FakeWorld(int size)
      : size_(size), barrier_(size), words_(static_cast<std::size_t>(size)) {}

  class Member final : public Ranks {
   public:
    Member(FakeWorld& world, int rank) : world_(world), rank_(rank) {}
    int rank() const override { return rank_; }
    int size() const override { return world_.size_; }
    int size_here() const override { return world_.size_; }
    int processors() const override { return 1; }

    std::vector<Word> exchange(const Word& own) override {
      world_.words_[static_cast<std::size_t>(rank_)] = own;
      world_.barrier_.arrive_and_wait();
      const std::vector<Word> all = world_.words_;
      world_.barrier_.arrive_and_wait();
      return all;
    }
    void broadcast(std::span<std::byte> bytes, int from) override {
      if (rank_ == from)
        world_.spoken_ = bytes;
      world_.barrier_.arrive_and_wait();
      if (rank_ != from)
        std::ranges::copy(world_.spoken_, bytes.begin());
      world_.barrier_.arrive_and_wait();
    }

   private:
    FakeWorld& world_;
    const int rank_;
  };

 private:
  const int size_;
  std::barrier<> barrier_;
  std::vector<Ranks::Word> words_;
  std::span<std::byte> spoken_;
};

// Calls work(ranks) in all ranks at once, each in a thread of its own.
inline void as_ranks(int size, const std::function<void(Ranks& ranks)>& work) {
  FakeWorld world(size);
  std::vector<std::thread> threads;
  for (int rank = 0; rank < size; ++rank)
    threads.emplace_back([&world, &work, rank] {
      FakeWorld::Member member(world, rank);
      work(member);
    });
  for (std::thread& thread : threads)
    thread.join();
}

}  // namespace ltc::test
