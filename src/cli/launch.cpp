// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/launch.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "core/error.h"
#include "core/parallel.h"
#ifdef LTCFIT_HAS_MPI
#include "mpi/mpi_ranks.h"
#endif

namespace ltc::cli {
namespace {

// Of Open MPI, of MPICH and others of its kind, of Slurm with PMIx.
struct Names {
  const char *rank, *size;
};
constexpr Names all_names[] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                               {"PMI_RANK", "PMI_SIZE"},
                               {"MV2_COMM_WORLD_RANK", "MV2_COMM_WORLD_SIZE"},
                               {"PMIX_RANK", "SLURM_STEP_NUM_TASKS"}};

std::optional<int> number_of(const char* text) {
  const std::string_view digits(text ? text : "");
  int number = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() && stop == digits.data() + digits.size() ? std::optional(number)
                                                                       : std::nullopt;
}

Ranks* joined = nullptr;

}  // namespace

std::optional<LaunchedAs> launched_as(
    const std::function<const char*(const char* name)>& environment) {
  for (const Names& names : all_names)
    if (const std::optional<int> rank = number_of(environment(names.rank))) {
      const std::optional<int> size = number_of(environment(names.size));
      return size == 1 ? std::nullopt : std::optional(LaunchedAs{*rank, size});
    }
  return std::nullopt;
}

std::string no_mpi_text(const LaunchedAs& launched) {
  return fmt::format(
      "started as one of {} ranks by a build without MPI: each would write the same files; build "
      "it with -DLTCFIT_MPI=ON, or start it once",
      launched.size ? std::to_string(*launched.size) : "several");
}

#ifdef LTCFIT_HAS_MPI
Launch::Launch(const std::optional<LaunchedAs>& launched)
    : ranks_(launched ? join_mpi_ranks() : nullptr) {
  joined = ranks_.get();
}
#else
Launch::Launch(const std::optional<LaunchedAs>& launched) {
  if (launched)
    throw InputError(no_mpi_text(*launched));
}
#endif

Launch::~Launch() {
  joined = nullptr;
}

Ranks* launched_ranks() {
  return joined;
}

int default_threads() {
  return joined ? joined->processors() : processor_count();
}

}  // namespace ltc::cli
