// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Runs that are killed, stopped or refused the disk, through the real program: what they leave, and
// what --resume makes of it.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <map>
#include <thread>

#include "core/random.h"
#include "export/checkpoint.h"
#include "export/hdf5.h"
#include "support/refused_run.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;

using Arguments = std::vector<std::string>;
using Files = std::map<std::string, std::string>;  // name and bytes

constexpr std::chrono::seconds limit{60};
const std::string checkpoint = "ltc.checkpoint.h5";

Arguments operator+(Arguments first, const Arguments& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

Arguments grid_of(const std::string& nodes) {
  Arguments arguments;
  for (const std::string axis : {"alpha", "lambda", "theta", "phi"})
    arguments = arguments + Arguments{"--set", "table." + axis + ".nodes=" + nodes};
  return arguments;
}

// By default into the working directory, with a checkpoint at every opportunity.
Arguments generate(const Arguments& more, const std::string& output = ".",
                   const std::string& checkpoint_seconds = "0.01") {
  return Arguments{"generate", "--output", output, "--checkpoint-seconds", checkpoint_seconds} +
         more;
}

// Seconds of work, most of it in the entries' own fits, some in three sweeps.
const Arguments with_sweeps =
    grid_of("3") +
    Arguments{"--config", LTCFIT_SOURCE_DIR "/config/reference.toml", "--threads", "1"};
// A second of work by the stochastic solver.
const Arguments stochastic =
    grid_of("3") + Arguments{"--config",  LTCFIT_SOURCE_DIR "/config/sgd.toml",
                             "--set",     "fit.sgd.steps=150",
                             "--threads", "1"};
// Sixteen entries in no time, and sixteen that would take hours.
const Arguments tiny = grid_of("2") + Arguments{"--set", "fit.gauss_newton.steps=2"};
const Arguments endless =
    grid_of("2") + Arguments{"--config",  LTCFIT_SOURCE_DIR "/config/paper.toml",
                             "--set",     "fit.sgd.steps=10000000",
                             "--threads", "2"};

// All files of a folder; in HDF5, the time of creation blanked.
Files files_in(const fs::path& folder) {
  Files files;
  for (const std::string& name : names_in(folder))
    files[name] = read_file(folder / name);
  if (const auto table = files.find("ltc.h5"); table != files.end()) {
    const std::string created = read_hdf5(folder / "ltc.h5").created;
    const std::size_t place = table->second.find(created);
    EXPECT_FALSE(created.empty());
    EXPECT_NE(place, std::string::npos);
    table->second.replace(place, created.size(), created.size(), ' ');
  }
  return files;
}

Files undisturbed(const Arguments& run) {
  const TemporaryDirectory folder;
  const ProgramResult result = run_ltcfit(generate(run), folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  Files files = files_in(folder.path());
  EXPECT_GE(files.size(), 4u);
  EXPECT_FALSE(files.contains(checkpoint));
  return files;
}

void expect_same_files(const Files& files, const Files& expected) {
  for (const auto& [name, bytes] : expected) {
    ASSERT_TRUE(files.contains(name)) << name << " is missing";
    EXPECT_TRUE(files.at(name) == bytes) << name << " differs";
  }
  EXPECT_EQ(files.size(), expected.size());
}

// Waits until the checkpoint has other bytes than the older one; false if the program ended before.
bool wait_for_new_checkpoint(RunningProgram& program, const fs::path& file,
                             const std::string& older) {
  return program.wait_until([&] { return fs::exists(file) && read_file(file) != older; }, limit);
}

Arguments command(const Arguments& arguments) {
  return Arguments{LTCFIT_PROGRAM} + arguments;
}

// Leaves a checkpoint of the run in the folder, and its bytes.
std::string leave_checkpoint(const Arguments& run, const fs::path& folder) {
  RunningProgram program(command(generate(run)), folder);
  EXPECT_TRUE(wait_for_new_checkpoint(program, folder / checkpoint, ""));
  program.send_signal(SIGKILL);
  EXPECT_EQ(program.wait(limit).exit_code, 128 + SIGKILL);
  return read_file(folder / checkpoint);
}

// ---- Killed and resumed ----

// Kills the run again and again, each time at a random moment after some progress, until it ends
// by itself. How often it was killed.
int kill_until_done(const Arguments& run, const fs::path& folder, std::uint64_t seed) {
  Random random(seed);
  int kills = 0;
  while (true) {
    const fs::path file = folder / checkpoint;
    const bool resume = fs::exists(file);
    const std::string older = resume ? read_file(file) : "";
    RunningProgram program(command(generate(resume ? run + Arguments{"--resume"} : run)), folder);
    if (wait_for_new_checkpoint(program, file, older))
      std::this_thread::sleep_for(std::chrono::duration<double>(0.15 * random.uniform()));
    program.send_signal(SIGKILL);
    const ProgramResult result = program.wait(limit);
    if (result.exit_code != 128 + SIGKILL) {
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_NE(result.out.find("resumed "), std::string::npos) << result.out;
      return kills;
    }
    ++kills;
    EXPECT_EQ(read_file(folder / "other.h5"), "of another program");
  }
}

void expect_kills_leave_no_trace(const Arguments& run) {
  const TemporaryDirectory folder;
  folder.write("other.h5", "of another program");
  Files expected = undisturbed(run);
  expected["other.h5"] = "of another program";
  EXPECT_GE(kill_until_done(run, folder.path(), 11), 3);
  expect_same_files(files_in(folder.path()), expected);
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

TEST(Resume, AfterAnInterruptGivesTheSameBytes) {
  const TemporaryDirectory folder;
  RunningProgram program(command(generate(stochastic)), folder.path());
  ASSERT_TRUE(wait_for_new_checkpoint(program, folder / checkpoint, ""));
  program.send_signal(SIGINT);
  const ProgramResult interrupted = program.wait(limit);
  EXPECT_EQ(interrupted.exit_code, 130);
  EXPECT_TRUE(
      interrupted.err.ends_with("ltcfit: interrupted; --resume goes on from ./ltc.checkpoint.h5\n"))
      << interrupted.err;
  EXPECT_EQ(names_in(folder.path()), Arguments{checkpoint});
  const ProgramResult resumed =
      run_ltcfit(generate(stochastic + Arguments{"--resume"}), folder.path());
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  expect_same_files(files_in(folder.path()), undisturbed(stochastic));
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
    // Some entries are done and more are not: with 0.01 seconds there would be one by now.
    EXPECT_FALSE(program.wait_until([&] { return fs::exists(folder / checkpoint); },
                                    std::chrono::seconds(1)));
    program.send_signal(SIGINT);
    program.wait(limit);
    EXPECT_FALSE(fs::exists(folder / checkpoint));
  }
}

// ---- What is refused ----

// As it stood: nothing added, nothing changed.
void expect_only(const fs::path& folder, const Files& expected) {
  Files files;
  for (const std::string& name : names_in(folder))
    files[name] = read_file(folder / name);
  expect_same_files(files, expected);
}

TEST(CheckpointFaults, ForgottenResumeLosesNothing) {
  const TemporaryDirectory folder;
  const std::string left = leave_checkpoint(stochastic, folder.path());
  platform::remove_abandoned_temporaries(folder / checkpoint);
  expect_error(run_ltcfit(generate(stochastic), folder.path()), 2,
               {"./ltc.checkpoint.h5", "--resume", "remove it"});
  expect_only(folder.path(), {{checkpoint, left}});
}

TEST(CheckpointFaults, OfAnotherConfigOrDamaged) {
  const TemporaryDirectory folder;
  const std::string left = leave_checkpoint(stochastic, folder.path());
  platform::remove_abandoned_temporaries(folder / checkpoint);
  folder.write("ltc.npy", "old");
  expect_error(run_ltcfit(generate(stochastic + Arguments{"--resume", "--set", "fit.seed=9"}),
                          folder.path()),
               2, {"./ltc.checkpoint.h5", "fit.seed = 1", "now it is 9"});
  expect_only(folder.path(), {{checkpoint, left}, {"ltc.npy", "old"}});
  folder.write(checkpoint, left.substr(0, left.size() / 2));
  expect_error(run_ltcfit(generate(stochastic + Arguments{"--resume"}), folder.path()), 2,
               {"./ltc.checkpoint.h5"});
  expect_only(folder.path(), {{checkpoint, left.substr(0, left.size() / 2)}, {"ltc.npy", "old"}});
}

TEST(CheckpointFaults, Seconds) {
  for (const char* seconds : {"-1", "86401", "soon", "", "nan", "1e999"})
    expect_refused({"generate", "--checkpoint-seconds", seconds}, 2,
                   {"--checkpoint-seconds", seconds, "[0, 86400]"});
}

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
// that is a full disk.
ProgramResult run_limited(int blocks, const Arguments& arguments, const fs::path& folder) {
  return run_program(
      Arguments{"sh", "-c", "ulimit -f " + std::to_string(blocks) + "; exec \"$@\"", "sh"} +
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
  expect_last_line(run_limited(4, generate(stochastic), folder.path()), 3,
                   {"cannot write ./ltc.checkpoint.h5", "File too large"});
  expect_only(folder.path(), {{"ltc.npy", "old"}});
}

TEST(FullDisk, LeavesTheLastCheckpointToGoOnFrom) {
  const TemporaryDirectory folder;
  const std::string left = leave_checkpoint(stochastic, folder.path());
  expect_last_line(run_limited(4, generate(stochastic + Arguments{"--resume"}), folder.path()), 3,
                   {"cannot write ./ltc.checkpoint.h5", "File too large",
                    "--resume goes on from ./ltc.checkpoint.h5"});
  expect_only(folder.path(), {{checkpoint, left}});
  EXPECT_EQ(run_ltcfit(generate(stochastic + Arguments{"--resume"}), folder.path()).exit_code, 0);
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
  const Arguments arguments = generate(stochastic, out.string());
  RunningProgram program(command(arguments));
  ASSERT_TRUE(wait_for_new_checkpoint(program, out / checkpoint, ""));
  fs::rename(out, folder / "elsewhere");
  expect_last_line(program.wait(limit), 3, {"cannot write", out.string(), "No such file"});
  EXPECT_EQ(names_in(folder.path()), Arguments{"elsewhere"});
}

TEST(VanishedFolder, IsAnErrorWhereThereAreNoCheckpoints) {
  const TemporaryDirectory folder;
  const fs::path out = folder / "out";
  RunningProgram program(command(generate(stochastic, out.string(), "0")));
  ASSERT_TRUE(program.wait_for_error_text("fit: ", limit));
  fs::remove_all(out);
  expect_last_line(program.wait(limit), 3, {"cannot write", out.string(), "No such file"});
  EXPECT_EQ(names_in(folder.path()), Arguments{});
}

// ---- Entries without a finite fit ----

// No lobe is known that a solver fails on, so a checkpoint says that some did.
void write_failures(const TemporaryDirectory& folder, std::size_t count) {
  Arguments overrides = tiny;
  std::erase(overrides, "--set");
  const Config config = load_config(std::nullopt, overrides);
  FinishedFits fits = FitJournal(config.grid.size(), 0).finished();
  for (std::size_t flat = 0; flat < count; ++flat) {
    fits.rounds[0][flat].matrix.setConstant(std::numeric_limits<double>::quiet_NaN());
    fits.rounds[0][flat].loss = std::numeric_limits<double>::quiet_NaN();
    fits.rounds[0][flat].status = Status::failed;
  }
  write_checkpoint(config, std::vector<bool>(config.grid.size(), true), fits, folder / checkpoint);
}

TEST(FailedEntries, AreWrittenAsSuchAndToldOf) {
  const TemporaryDirectory folder;
  write_failures(folder, 1);
  const ProgramResult result = run_ltcfit(generate(tiny + Arguments{"--resume"}), folder.path());
  EXPECT_EQ(result.exit_code, 1);
  const Table table = read_hdf5(folder / "ltc.h5");
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
