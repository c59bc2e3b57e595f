// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Runs that are in each other's way or are refused the disk, and entries that no fit was found for,
// through the real program.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <limits>

#include "export/checkpoint.h"
#include "export/table_file.h"
#include "support/generate_runs.h"
#include "support/refused_run.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using namespace runs;

// ---- Two runs in one folder ----

TEST(TwoRuns, TheSecondIsRefusedUntilTheFirstIsGone) {
  const TemporaryDirectory folder;
  RunningProgram first(command(generate(endless)), folder.path());
  ASSERT_TRUE(first.wait_for_error_text("fit: ", limit));
  expect_error(run_ltcfit(generate(tiny), folder.path()), 3, {"another run", "folder ."});
  EXPECT_EQ(names_in(folder.path()), Arguments{});
  // Not even a killed one keeps its lock.
  first.send_signal(SIGKILL);
  EXPECT_EQ(first.wait(limit).exit_code, 128 + SIGKILL);
  EXPECT_EQ(run_ltcfit(generate(tiny), folder.path()).exit_code, 0);
}

// ---- Disks that refuse ----

// The program in a shell, no file of which may grow beyond so many blocks of 512 bytes: to a writer
// that is a full disk. Counts of lines that run (scripts/coverage) would be cut short too, and
// spoil those of all other tests: they go where nobody looks. Where nothing can be written the
// program's counters would say so among its own errors. The thread sanitizer maps a file of its
// own, which the limit would cut short too; it does without where it finds no place for one.
ProgramResult run_limited(int blocks, const Arguments& arguments, const fs::path& folder) {
  const TemporaryDirectory counts;
  return run_program(Arguments{"sh", "-c",
                               "ulimit -f " + std::to_string(blocks) +
                                   "; export GCOV_PREFIX=" + counts.path().string() +
                                   "; export TEST_TMPDIR=/nowhere; exec \"$@\"",
                               "sh"} +
                         command(arguments),
                     folder);
}

// The last line on standard error is the error; those before tell of progress.
void expect_last_line(const ProgramResult& result, int exit_code, const Arguments& parts) {
  const std::size_t begin = result.err.rfind('\n', result.err.size() - 2) + 1;
  expect_error({result.exit_code, result.out, result.err.substr(begin)}, exit_code, parts);
  EXPECT_EQ(result.err.find("ltcfit: "), begin) << result.err;
}

TEST(FullDisk, LeavesTheOlderSetOfFilesWhole) {
  const TemporaryDirectory folder;
  const Files old = {{"ltc.0.exr", "0"},
                     {"ltc.1.exr", "1"},
                     {"ltc.2.exr", "2"},
                     {"ltc.h5", "h5"},
                     {"ltc.npy", "npy"}};
  for (const auto& [name, bytes] : old)
    folder.write(name, bytes);
  // With 81 entries: textures of 1.5 kB fit into 2 kB, the array of 3 kB does not.
  const Arguments run = grid_of("3") + Arguments{"--set", "fit.gauss_newton.steps=2"};
  const auto generate_at_once = [&](const Arguments& more) {
    return generate(run + more, ".", "0");
  };
  expect_last_line(run_limited(4, generate_at_once({"--set", "output.hdf5=false"}), folder.path()),
                   3, {"cannot write ./ltc.npy", "File too large"});
  expect_only(folder.path(), old);
  expect_last_line(run_limited(4, generate_at_once({}), folder.path()), 3,
                   {"cannot write ./ltc.h5", "File too large"});
  expect_only(folder.path(), old);
  EXPECT_EQ(run_limited(1000, generate_at_once({}), folder.path()).exit_code, 0);
}

TEST(FullDisk, EndsARunWhoseCheckpointDoesNotFit) {
  const TemporaryDirectory folder;
  folder.write("ltc.npy", "old");
  expect_last_line(run_limited(4, generate(lengthy), folder.path()), 3,
                   {"cannot write ./ltc.checkpoint.h5", "File too large"});
  expect_only(folder.path(), {{"ltc.npy", "old"}});
}

TEST(FullDisk, LeavesTheLastCheckpointToGoOnFrom) {
  const TemporaryDirectory folder;
  const std::string left = leave_checkpoint(folder.path());
  expect_last_line(run_limited(4, generate(lengthy + Arguments{"--resume"}), folder.path()), 3,
                   {"cannot write ./ltc.checkpoint.h5", "File too large",
                    "--resume goes on from ./ltc.checkpoint.h5"});
  expect_only(folder.path(), {{checkpoint, left}});
}

// Runs a script of the shell with a file system of its own mounted on `folder`; "skipped" on
// standard output where this user may not mount.
ProgramResult run_mounted(const std::string& options, const std::string& script,
                          const fs::path& folder) {
  const std::string mounted = "mount -t tmpfs -o " + options + " tmpfs \"$0\" && cd \"$0\" && ";
  const ProgramResult possible =
      run_program({"unshare", "-m", "sh", "-c", mounted + "true", folder.string()});
  if (possible.exit_code != 0)
    return {0, "skipped", possible.err};
  return run_program(
      {"unshare", "-m", "sh", "-c", mounted + script, folder.string(), LTCFIT_PROGRAM});
}

std::string quoted(const Arguments& arguments) {
  std::string text = "\"$1\"";
  for (const std::string& argument : arguments)
    text += " '" + argument + "'";
  return text;
}

TEST(FullDisk, OfARealFileSystem) {
  const TemporaryDirectory folder;
  const ProgramResult result = run_mounted(
      "size=8k", quoted(generate(tiny, ".", "0")) + "; code=$?; ls -A; exit $code", folder.path());
  if (result.out == "skipped")
    GTEST_SKIP() << "this user may not mount a file system: " << result.err;
  EXPECT_EQ(result.out, "");  // nothing is left
  expect_last_line(result, 3, {"cannot write ./ltc.", "No space left on device"});
}

TEST(ReadOnlyFolder, IsRefusedBeforeAnyWork) {
  const TemporaryDirectory folder;
  const ProgramResult result =
      run_mounted("ro", quoted(generate(tiny)) + "; code=$?; ls -A; exit $code", folder.path());
  if (result.out == "skipped")
    GTEST_SKIP() << "this user may not mount a file system: " << result.err;
  expect_error(result, 3, {"cannot write into output folder .", "Read-only file system"});
}

// Unwritable even to root.
TEST(ReadOnlyFolder, OfTheSystem) {
  expect_error(run_ltcfit({"generate", "--output", "/proc/self"}), 3,
               {"cannot write into output folder /proc/self"});
}

TEST(VanishedFolder, EndsTheRunAtItsNextCheckpoint) {
  const TemporaryDirectory folder;
  const fs::path out = folder / "out";
  RunningProgram program(command(generate(lengthy, out.string())));
  ASSERT_TRUE(wait_for_new_checkpoint(program, out / checkpoint, ""));
  fs::rename(out, folder / "elsewhere");
  expect_last_line(program.wait(limit), 3, {"cannot write", out.string(), "No such file"});
  EXPECT_EQ(names_in(folder.path()), Arguments{"elsewhere"});
}

TEST(VanishedFolder, IsAnErrorWhereThereAreNoCheckpoints) {
  until_disturbed([] {
    const TemporaryDirectory folder;
    const fs::path out = folder / "out";
    RunningProgram program(command(generate(stochastic, out.string(), "0")));
    program.wait_for_error_text("fit: ", limit);
    fs::rename(out, folder / "elsewhere");
    const ProgramResult result = program.wait(limit);
    if (result.exit_code == 0)
      return false;
    expect_last_line(result, 3, {"cannot write", out.string(), "No such file"});
    EXPECT_EQ(names_in(folder.path()), Arguments{"elsewhere"});
    return true;
  });
}

// ---- Entries without a finite fit ----

// No lobe is known that a solver fails on, so a checkpoint says that some did.
void write_failures(const TemporaryDirectory& folder, std::size_t count) {
  Arguments overrides = tiny;
  std::erase(overrides, "--set");
  const Config config = load_config(std::nullopt, overrides);
  FinishedFits fits = FitJournal(config.grid.size(), 0).finished();
  FittedEntry failed;
  failed.matrix.setConstant(std::numeric_limits<double>::quiet_NaN());
  failed.loss = std::numeric_limits<double>::quiet_NaN();
  failed.status = Status::failed;
  for (std::size_t flat = 0; flat < count; ++flat)
    fits.rounds[0].set(flat, failed);
  write_checkpoint(config, std::vector<bool>(config.grid.size(), true), fits, folder / checkpoint);
}

TEST(FailedEntries, AreWrittenAsSuchAndToldOf) {
  const TemporaryDirectory folder;
  write_failures(folder, 1);
  const ProgramResult result = run_ltcfit(generate(tiny + Arguments{"--resume"}), folder.path());
  EXPECT_EQ(result.exit_code, 1);
  const Table table = read_table(folder / "ltc.h5");
  const auto failed = std::count(table.status.begin(), table.status.end(), Status::failed);
  EXPECT_GE(failed, 1);
  EXPECT_TRUE(result.err.ends_with("ltcfit: " + std::to_string(failed) +
                                   " of 16 entries have no finite fit and hold NaN, entry 0,0,0,0 "
                                   "the first; the files were written\n"))
      << result.err;
  EXPECT_NE(result.out.find("wrote    ./ltc.h5\n"), std::string::npos) << result.out;
  EXPECT_EQ(names_in(folder.path()).size(), 5u);
}

TEST(FailedEntries, AloneMakeNoTable) {
  const TemporaryDirectory folder;
  write_failures(folder, 16);
  expect_last_line(run_ltcfit(generate(tiny + Arguments{"--resume"}), folder.path()), 1,
                   {"none of 16 entries has a finite fit", "nothing was written"});
  EXPECT_EQ(names_in(folder.path()), Arguments{checkpoint});
}

}  // namespace
}  // namespace ltc::test
