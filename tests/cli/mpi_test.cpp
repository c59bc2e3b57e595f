// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Runs of several ranks on this machine, through the real launcher: the same files as one process
// makes, and one end for all of them.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "support/generate_runs.h"
#include "support/refused_run.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using namespace runs;

#ifdef LTCFIT_MPI_LAUNCHER
const Arguments launcher = LTCFIT_MPI_LAUNCHER;
#else
const Arguments launcher;
#endif

class Mpi : public ::testing::Test {
 protected:
  void SetUp() override {
    if (launcher.empty())
      GTEST_SKIP() << "a build without MPI";
    setenv("SOURCE_DATE_EPOCH", "1", 1);  // a field's files state the time too
  }
  void TearDown() override { unsetenv("SOURCE_DATE_EPOCH"); }
};

Arguments on(int ranks, const Arguments& command) {
  return launcher + Arguments{"-n", std::to_string(ranks)} + command;
}

ProgramResult run_on(int ranks, const Arguments& arguments, const fs::path& folder) {
  return run_program(on(ranks, command(arguments)), folder);
}

// Each rank leaves its process' number in the folder.
Arguments numbered(const Arguments& arguments) {
  return Arguments{"sh", "-c", "echo $$ > pid.$OMPI_COMM_WORLD_RANK; exec \"$@\"", "sh"} +
         command(arguments);
}
void send_to_rank(int rank, int signal, const fs::path& folder) {
  pid_t process = 0;
  std::ifstream(folder / ("pid." + std::to_string(rank))) >> process;
  ASSERT_GT(process, 1);
  ::kill(process, signal);
}
void remove_numbers(const fs::path& folder) {
  for (const std::string& name : names_in(folder))
    if (name.starts_with("pid."))
      fs::remove(folder / name);
}

// That the launcher may add to.
std::string own_lines(const std::string& err) {
  std::string own;
  for (std::size_t at = 0; at < err.size();) {
    const std::size_t end = std::min(err.find('\n', at), err.size() - 1) + 1;
    if (err.compare(at, 8, "ltcfit: ") == 0)
      own += err.substr(at, end - at);
    at = end;
  }
  return own;
}

// ---- The same bytes ----

void expect_same_bytes(const Arguments& run) {
  const TemporaryDirectory folder;
  const ProgramResult result = run_on(4, generate(run), folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out.find("entries  "), result.out.rfind("entries  ")) << result.out;
  expect_same_files(files_in(folder.path()), undisturbed(run));
}

TEST_F(Mpi, FourRanksRefineToTheSameBytes) {
  expect_same_bytes(grid_of("2") + Arguments{"--set", "refine.queries_per_cell=60", "--set",
                                             "refine.held_out_queries=100", "--set",
                                             "refine.steps=3"});
}

TEST_F(Mpi, FourRanksSweepToTheSameBytes) {
  expect_same_bytes(with_sweeps + Arguments{"--set", "refine.steps=0"});
}

TEST_F(Mpi, FourRanksMakeTheSameField) {
  expect_same_bytes({"--config", LTCFIT_SOURCE_DIR "/config/field.toml", "--set", "field.size=64",
                     "--set", "field.albedo_size=40", "--set", "field.queries=1000", "--set",
                     "field.steps=1", "--set", "table.alpha.nodes=3", "--set",
                     "table.lambda.nodes=2", "--set", "table.theta.nodes=3", "--set",
                     "table.phi.nodes=2"});
}

// The comparison can fail.
TEST_F(Mpi, AnotherSeedMakesOtherFiles) {
  const Arguments quick =
      grid_of("2") + Arguments{"--set", "fit.solver=sgd", "--set", "fit.sgd.steps=3",
                               "--set", "refine.steps=0", "--set", "fit.seed="};
  const auto with_seed = [&](const char* seed) {
    Arguments run = quick;
    run.back() += seed;
    return run;
  };
  const TemporaryDirectory folder;
  ASSERT_EQ(run_on(2, generate(with_seed("2")), folder.path()).exit_code, 0);
  EXPECT_TRUE(files_in(folder.path()) == undisturbed(with_seed("2")));
  EXPECT_FALSE(files_in(folder.path()) == undisturbed(with_seed("3")));
}

TEST_F(Mpi, OneRankSpeaksAndDoesWhatCannotBeShared) {
  const TemporaryDirectory folder;
  const ProgramResult version = run_on(3, {"--version"}, folder.path());
  EXPECT_EQ(version.out, run_ltcfit({"--version"}).out);
  const ProgramResult help = run_on(3, {"generate", "--help"}, folder.path());
  EXPECT_EQ(std::count(help.out.begin(), help.out.end(), '\n'), [&] {
    const std::string alone = run_ltcfit({"generate", "--help"}).out;
    return std::count(alone.begin(), alone.end(), '\n');
  }());
  const ProgramResult man = run_on(3, {"man"}, folder.path());
  EXPECT_EQ(man.out, run_ltcfit({"man"}).out);
}

// ---- One end for all ----

TEST_F(Mpi, WhatIsRefusedIsToldOnce) {
  const TemporaryDirectory folder;
  expect_error(run_on(4, generate({"--set", "fit.seed=-1"}), folder.path()), 2, {"fit.seed"});
  expect_error(run_on(4, generate({}, "/proc/self"), folder.path()), 3, {"/proc/self"});
  expect_error(run_on(4, {"generat"}, folder.path()), 2, {"unknown command"});
  EXPECT_EQ(names_in(folder.path()), Arguments{});
}

TEST_F(Mpi, AnErrorOfOneRankIsTheEndOfAll) {
  const TemporaryDirectory folder;
  const Arguments of_all = command(generate(tiny));
  const auto second_with = [&](const Arguments& more) {
    return run_program(
        launcher + Arguments{"-n", "1"} + of_all + Arguments{":", "-n", "1"} + of_all + more,
        folder.path());
  };
  expect_error(second_with({"--scene", "none.toml"}), 3, {"none.toml"});
  expect_error(second_with({"--scene", LTCFIT_SOURCE_DIR "/config/scenes/brushed-metal.toml"}), 2,
               {"rank 1 has another than rank 0", "scene"});
  EXPECT_EQ(names_in(folder.path()), Arguments{});
}

TEST_F(Mpi, AFolderThatVanishesEndsAll) {
  const TemporaryDirectory folder;
  const fs::path out = folder / "out";
  RunningProgram program(on(3, command(generate(lengthy, out.string()))), folder.path());
  ASSERT_TRUE(wait_for_new_checkpoint(program, out / checkpoint, ""));
  fs::rename(out, folder / "elsewhere");
  const ProgramResult result = program.wait(limit);
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_EQ(own_lines(result.err).find("ltcfit: cannot write"), 0u) << result.err;
  EXPECT_EQ(std::ranges::count(own_lines(result.err), '\n'), 1) << result.err;
}

// Whichever rank is asked, all stop, and the checkpoint is brought up to date.
TEST_F(Mpi, AStopOfOneRankStopsAll) {
  for (const int rank : {0, 2}) {
    const TemporaryDirectory folder;
    RunningProgram program(on(3, numbered(generate(lengthy))), folder.path());
    ASSERT_TRUE(wait_for_new_checkpoint(program, folder / checkpoint, ""));
    send_to_rank(rank, SIGTERM, folder.path());
    const ProgramResult result = program.wait(limit);
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_EQ(own_lines(result.err),
              "ltcfit: interrupted; --resume goes on from ./ltc.checkpoint.h5\n")
        << result.err;
    remove_numbers(folder.path());
    EXPECT_EQ(names_in(folder.path()), Arguments{checkpoint});
  }
}

// The launcher's own exit code is its own affair.
TEST_F(Mpi, AnInterruptOfTheLauncherStopsAll) {
  const TemporaryDirectory folder;
  RunningProgram program(on(3, command(generate(lengthy))), folder.path());
  ASSERT_TRUE(wait_for_new_checkpoint(program, folder / checkpoint, ""));
  program.send_signal(SIGINT);
  const ProgramResult result = program.wait(limit);
  EXPECT_NE(result.exit_code, 0);
  EXPECT_EQ(own_lines(result.err),
            "ltcfit: interrupted; --resume goes on from ./ltc.checkpoint.h5\n")
      << result.err;
  EXPECT_EQ(names_in(folder.path()), Arguments{checkpoint});
}

TEST_F(Mpi, KilledRanksAreResumedByAnyNumber) {
  const Files expected = undisturbed(stochastic);
  until_disturbed([&] {
    const TemporaryDirectory folder;
    {
      RunningProgram program(on(4, numbered(generate(stochastic))), folder.path());
      wait_for_new_checkpoint(program, folder / checkpoint, "");
      send_to_rank(0, SIGKILL, folder.path());
      if (program.wait(limit).exit_code == 0)
        return false;
    }
    remove_numbers(folder.path());
    if (!fs::exists(folder / checkpoint))
      return false;
    const std::string left = read_file(folder / checkpoint);
    for (const int ranks : {1, 2}) {
      folder.write(checkpoint, left);
      const Arguments resume = generate(stochastic + Arguments{"--resume"});
      const ProgramResult resumed =
          ranks == 1 ? run_ltcfit(resume, folder.path()) : run_on(ranks, resume, folder.path());
      EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
      EXPECT_NE(resumed.out.find("resumed "), std::string::npos) << resumed.out;
      expect_same_files(files_in(folder.path()), expected);
    }
    return true;
  });
}

// Four copies of a run would be four writers of the same files.
TEST(WithoutMpi, SeveralCopiesAreRefusedInOneLine) {
  if (!launcher.empty())
    GTEST_SKIP() << "a build with MPI";
  const TemporaryDirectory folder;
  const auto run_as = [&](const char* rank) {
    return run_program(
        Arguments{"env", "OMPI_COMM_WORLD_SIZE=4", std::string("OMPI_COMM_WORLD_RANK=") + rank} +
            command(generate(tiny)),
        folder.path());
  };
  expect_error(run_as("0"), 2, {"one of 4 ranks", "without MPI", "LTCFIT_MPI"});
  const ProgramResult other = run_as("1");
  EXPECT_EQ(other.err + other.out, "");
  EXPECT_EQ(names_in(folder.path()), Arguments{});
}

}  // namespace
}  // namespace ltc::test
