// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/launch.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "core/error.h"

namespace ltc::cli {
namespace {

std::optional<LaunchedAs> in(const std::map<std::string, std::string>& environment) {
  return launched_as([&](const char* name) {
    const auto found = environment.find(name);
    return found == environment.end() ? nullptr : found->second.c_str();
  });
}

TEST(Launch, IsFoundInTheEnvironmentOfLaunchers) {
  for (const auto& [rank, size] : {std::pair{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                   {"PMI_RANK", "PMI_SIZE"},
                                   {"MV2_COMM_WORLD_RANK", "MV2_COMM_WORLD_SIZE"},
                                   {"PMIX_RANK", "SLURM_STEP_NUM_TASKS"}}) {
    const auto launched = in({{rank, "2"}, {size, "4"}});
    ASSERT_TRUE(launched) << rank;
    EXPECT_EQ(launched->rank, 2);
    EXPECT_EQ(launched->size, 4);
  }
  const auto unknown = in({{"PMIX_RANK", "0"}});
  ASSERT_TRUE(unknown);
  EXPECT_FALSE(unknown->size);
}

TEST(Launch, OneProcessIsAlone) {
  EXPECT_FALSE(in({}));
  EXPECT_FALSE(in({{"OMPI_COMM_WORLD_RANK", "0"}, {"OMPI_COMM_WORLD_SIZE", "1"}}));
  EXPECT_FALSE(in({{"PMI_RANK", ""}, {"PMI_SIZE", "4"}}));
  EXPECT_FALSE(in({{"PMI_RANK", "one"}, {"PMI_SIZE", "4"}}));
  EXPECT_EQ(launched_ranks(), nullptr);
  EXPECT_GE(default_threads(), 1);
}

TEST(Launch, WithoutMpiTheReasonSaysWhatToDo) {
  EXPECT_EQ(no_mpi_text({0, 4}),
            "started as one of 4 ranks by a build without MPI: each would write the same files; "
            "build it with -DLTCFIT_MPI=ON, or start it once");
  EXPECT_NE(no_mpi_text({0, std::nullopt}).find("one of several ranks"), std::string::npos);
}

// The tests' own build of it has none.
TEST(Launch, ABuildWithoutMpiRefuses) {
  EXPECT_THROW(Launch(LaunchedAs{0, 4}), InputError);
  EXPECT_NO_THROW(Launch(std::nullopt));
}

}  // namespace
}  // namespace ltc::cli
