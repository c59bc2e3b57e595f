// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "mpi/mpi_ranks.h"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "core/parallel.h"
#include "core/platform.h"

namespace ltc {
namespace {

// MPI counts in int.
constexpr std::size_t most_bytes_at_once = std::size_t{1} << 30;

// MPI would wait with all the power of a processor, which others may have work for: one rank alone
// writes files, and ranks may be more than processors.
void wait_for(MPI_Request request) {
  constexpr std::chrono::microseconds first{10}, longest{500};
  int is_complete = 0;
  MPI_Test(&request, &is_complete, MPI_STATUS_IGNORE);
  for (auto pause = first; !is_complete; pause = std::min(2 * pause, longest)) {
    std::this_thread::sleep_for(pause);
    MPI_Test(&request, &is_complete, MPI_STATUS_IGNORE);
  }
}

// Of the processors that this process may use, those that are left to it by other ranks on its
// machine that may use them too: launchers may give each rank its own.
int processors_of_rank(MPI_Comm here, int size_here) {
  std::vector<std::uint8_t> own = platform::allowed_processors();
  const int length = static_cast<int>(own.size());
  std::vector<std::uint8_t> all(own.size() * static_cast<std::size_t>(size_here));
  MPI_Allgather(own.data(), length, MPI_UINT8_T, all.data(), length, MPI_UINT8_T, here);
  int sharing = 0;
  for (std::size_t first = 0; first < all.size(); first += own.size()) {
    bool shares = false;
    for (std::size_t i = 0; i < own.size(); ++i)
      shares = shares || (own[i] && all[first + i]);
    sharing += shares;
  }
  return std::max(1, processor_count() / std::max(sharing, 1));
}

class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm here = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    MPI_Comm_size(here, &size_here_);
    processors_ = processors_of_rank(here, size_here_);
    MPI_Comm_free(&here);
  }
  ~MpiRanks() override { MPI_Finalize(); }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int size_here() const override { return size_here_; }
  int processors() const override { return processors_; }

  std::vector<Word> exchange(const Word& own) override {
    std::vector<Word> all(static_cast<std::size_t>(size_));
    constexpr int length = std::tuple_size_v<Word>;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallgather(own.data(), length, MPI_UINT64_T, all.data(), length, MPI_UINT64_T,
                   MPI_COMM_WORLD, &request);
    wait_for(request);
    return all;
  }

  void broadcast(std::span<std::byte> bytes, int from) override {
    while (!bytes.empty()) {
      const std::size_t count = std::min(bytes.size(), most_bytes_at_once);
      MPI_Bcast(bytes.data(), static_cast<int>(count), MPI_BYTE, from, MPI_COMM_WORLD);
      bytes = bytes.subspan(count);
    }
  }

 private:
  int rank_ = 0, size_ = 1, size_here_ = 1, processors_ = 1;
};

}  // namespace

std::unique_ptr<Ranks> join_mpi_ranks() {
  auto ranks = std::make_unique<MpiRanks>();
  if (ranks->size() == 1)
    return nullptr;
  return ranks;
}

}  // namespace ltc
