// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Processes that a launcher such as mpirun started together.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/ranks.h"

namespace ltc::cli {

// What a launcher says in the environment; of PMIx alone no size.
struct LaunchedAs {
  int rank = 0;
  std::optional<int> size;
};
// Nothing for a process that is alone. `environment` is std::getenv.
std::optional<LaunchedAs> launched_as(
    const std::function<const char*(const char* name)>& environment);

// Why a build without MPI does no work then.
std::string no_mpi_text(const LaunchedAs& launched);

// The ranks that this process is one of, joined for as long as it lives. One a process.
class Launch {
 public:
  // Throws InputError for several processes of a build without MPI: each would write the same
  // files.
  explicit Launch(const std::optional<LaunchedAs>& launched);
  ~Launch();
  Launch(const Launch&) = delete;
  Launch& operator=(const Launch&) = delete;

 private:
  std::unique_ptr<Ranks> ranks_;
};

// Null where this process is alone.
Ranks* launched_ranks();

// The processors that it has for itself.
int default_threads();

}  // namespace ltc::cli
