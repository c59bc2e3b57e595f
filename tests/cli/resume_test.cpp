// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Runs that are killed or stopped, through the real program: what --resume makes of what they
// leave.
#include <gtest/gtest.h>
#include <signal.h>

#include <thread>

#include "core/platform.h"
#include "core/random.h"
#include "support/generate_runs.h"
#include "support/refused_run.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using namespace runs;

// ---- Killed and resumed ----

// Enough to be killed while it resumes what was killed while it resumed; more only takes time.
constexpr int most_kills = 8;

// Kills the run again and again, each time at a random moment after some progress, and lets it come
// to its end after the last time. How often it was killed.
int kill_until_done(const Arguments& run, const fs::path& folder, std::uint64_t seed) {
  Random random(seed);
  int kills = 0;
  while (true) {
    const fs::path file = folder / checkpoint;
    const bool resume = fs::exists(file);
    const std::string older = resume ? read_file(file) : "";
    RunningProgram program(command(generate(resume ? run + Arguments{"--resume"} : run)), folder);
    if (kills < most_kills) {
      if (wait_for_new_checkpoint(program, file, older))
        std::this_thread::sleep_for(std::chrono::duration<double>(0.02 * random.uniform()));
      program.send_signal(SIGKILL);
    }
    const ProgramResult result = program.wait(limit);
    if (result.exit_code != 128 + SIGKILL) {
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_EQ(result.out.find("resumed ") != std::string::npos, resume) << result.out;
      return kills;
    }
    ++kills;
    EXPECT_EQ(read_file(folder / "other.h5"), "of another program");
  }
}

void expect_kills_leave_no_trace(const Arguments& run) {
  Files expected = undisturbed(run);
  expected["other.h5"] = "of another program";
  std::uint64_t seed = 11;
  until_disturbed([&] {
    const TemporaryDirectory folder;
    folder.write("other.h5", "of another program");
    const int kills = kill_until_done(run, folder.path(), seed++);
    expect_same_files(files_in(folder.path()), expected);
    return kills >= 3;
  });
}

TEST(Resume, AfterKillsGivesTheSameBytesWithSweeps) {
  expect_kills_leave_no_trace(with_sweeps);
}

TEST(Resume, AfterKillsGivesTheSameBytesWithTheStochasticSolver) {
  expect_kills_leave_no_trace(stochastic);
}

// The comparison above can fail: another seed makes other files.
TEST(Resume, FilesOfAnotherRunAreToldApart) {
  const Arguments quick =
      grid_of("2") +
      Arguments{"--set", "fit.solver=sgd", "--set", "fit.sgd.steps=3", "--set", "fit.seed=2"};
  const Files files = undisturbed(quick);
  EXPECT_FALSE(files == undisturbed(quick + Arguments{"--set", "fit.seed=3"}));
  EXPECT_TRUE(files == undisturbed(quick));
}

// Whether an interrupt at its first checkpoint came before the run's end; it then left the
// checkpoint and said so.
bool interrupt_at_checkpoint(const Arguments& run, const fs::path& folder) {
  RunningProgram program(command(generate(run)), folder);
  wait_for_new_checkpoint(program, folder / checkpoint, "");
  program.send_signal(SIGINT);
  const ProgramResult result = program.wait(limit);
  if (result.exit_code == 0)
    return false;
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_TRUE(
      result.err.ends_with("ltcfit: interrupted; --resume goes on from ./ltc.checkpoint.h5\n"))
      << result.err;
  EXPECT_EQ(names_in(folder), Arguments{checkpoint});
  return true;
}

TEST(Resume, AfterAnInterruptGivesTheSameBytes) {
  until_disturbed([] {
    const TemporaryDirectory folder;
    if (!interrupt_at_checkpoint(stochastic, folder.path()))
      return false;
    const ProgramResult resumed =
        run_ltcfit(generate(stochastic + Arguments{"--resume"}), folder.path());
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    expect_same_files(files_in(folder.path()), undisturbed(stochastic));
    return true;
  });
}

TEST(Resume, WithoutACheckpointStartsAndSaysSo) {
  const TemporaryDirectory folder;
  const ProgramResult result = run_ltcfit(generate(tiny + Arguments{"--resume"}), folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("no checkpoint ./ltc.checkpoint.h5; starting from the beginning\n"),
            std::string::npos)
      << result.err;
  EXPECT_EQ(result.out.find("resumed "), std::string::npos) << result.out;
  expect_same_files(files_in(folder.path()), undisturbed(tiny));
}

TEST(Resume, TakesAwayWhatAKilledWriterLeft) {
  const TemporaryDirectory folder;
  folder.write(".ltc.h5.4711.tmp", "half of it");
  folder.write("." + checkpoint + ".4711.tmp", "half of it");
  ASSERT_EQ(run_ltcfit(generate(tiny), folder.path()).exit_code, 0);
  expect_same_files(files_in(folder.path()), undisturbed(tiny));
}

TEST(Checkpoint, IsNotWrittenBeforeItsTimeNorWithNoughtSeconds) {
  for (const char* seconds : {"0", "86400"}) {
    const TemporaryDirectory folder;
    RunningProgram program(command(generate(stochastic, ".", seconds)), folder.path());
    // Looked for as long as the run works: with 0.01 seconds there is one most of that time.
    EXPECT_FALSE(program.wait_until([&] { return fs::exists(folder / checkpoint); }, limit));
    EXPECT_EQ(program.wait(limit).exit_code, 0);
  }
}

// ---- What is refused ----

TEST(CheckpointFaults, ForgottenResumeLosesNothing) {
  const TemporaryDirectory folder;
  const std::string left = leave_checkpoint(folder.path());
  platform::remove_abandoned_temporaries(folder / checkpoint);
  expect_error(run_ltcfit(generate(lengthy), folder.path()), 2,
               {"./ltc.checkpoint.h5", "--resume", "remove it"});
  expect_only(folder.path(), {{checkpoint, left}});
}

TEST(CheckpointFaults, OfAnotherConfigOrDamaged) {
  const TemporaryDirectory folder;
  const std::string left = leave_checkpoint(folder.path());
  platform::remove_abandoned_temporaries(folder / checkpoint);
  folder.write("ltc.npy", "old");
  expect_error(
      run_ltcfit(generate(lengthy + Arguments{"--resume", "--set", "fit.seed=9"}), folder.path()),
      2, {"./ltc.checkpoint.h5", "fit.seed = 1", "now it is 9"});
  expect_only(folder.path(), {{checkpoint, left}, {"ltc.npy", "old"}});
  folder.write(checkpoint, left.substr(0, left.size() / 2));
  expect_error(run_ltcfit(generate(lengthy + Arguments{"--resume"}), folder.path()), 2,
               {"./ltc.checkpoint.h5"});
  expect_only(folder.path(), {{checkpoint, left.substr(0, left.size() / 2)}, {"ltc.npy", "old"}});
}

// Without a guard around the HDF5 library this file ends the program with a signal.
TEST(CheckpointFaults, ThatCrashesTheHdf5Library) {
  const TemporaryDirectory folder;
  const std::string crasher =
      read_file(LTCFIT_SOURCE_DIR "/tests/fuzz/crashers/hdf5/object_of_a_fractal_heap.h5");
  folder.write(checkpoint, crasher);
  folder.write("ltc.npy", "old");
  expect_error(run_ltcfit(generate(tiny + Arguments{"--resume"}), folder.path()), 2,
               {"./ltc.checkpoint.h5", "damaged: the HDF5 library cannot cope with it"});
  expect_only(folder.path(), {{checkpoint, crasher}, {"ltc.npy", "old"}});
}

TEST(CheckpointFaults, Seconds) {
  for (const char* seconds : {"-1", "86401", "soon", "", "nan", "1e999"})
    expect_refused({"generate", "--checkpoint-seconds", seconds}, 2,
                   {"--checkpoint-seconds", seconds, "[0, 86400]"});
}

// As nohup starts it: the end of the terminal is not its own.
TEST(Interrupt, ThatTheProgramWasStartedToIgnoreIsIgnored) {
  const TemporaryDirectory folder;
  RunningProgram program(Arguments{"sh", "-c", "trap '' HUP; exec \"$@\"", "sh"} +
                             command(generate(stochastic, ".", "0")),
                         folder.path());
  ASSERT_TRUE(program.wait_for_error_text("fit: ", limit));
  program.send_signal(SIGHUP);
  EXPECT_EQ(program.wait(limit).exit_code, 0);
}

// The terminal closes: the same as Ctrl-C.
TEST(Interrupt, ByHangUpUpdatesTheCheckpoint) {
  const TemporaryDirectory folder;
  RunningProgram program(command(generate(stochastic + Arguments{"--set", "fit.sgd.steps=2000"})),
                         folder.path());
  ASSERT_TRUE(wait_for_new_checkpoint(program, folder / checkpoint, ""));
  program.send_signal(SIGHUP);
  const ProgramResult result = program.wait(limit);
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_TRUE(result.err.ends_with("--resume goes on from ./ltc.checkpoint.h5\n")) << result.err;
}

}  // namespace
}  // namespace ltc::test
