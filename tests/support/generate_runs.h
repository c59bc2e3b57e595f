// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Runs of `ltcfit generate` that keep checkpoints, and the files that they leave.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "export/table_file.h"
#include "support/program.h"
#include "test_paths.h"

namespace ltc::test::runs {

using Arguments = std::vector<std::string>;
using Files = std::map<std::string, std::string>;  // name and bytes

inline constexpr std::chrono::seconds limit = patience;
inline const std::string checkpoint = "ltc.checkpoint.h5";

inline Arguments operator+(Arguments first, const Arguments& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

inline Arguments grid_of(const std::string& nodes) {
  Arguments arguments;
  for (const std::string axis : {"alpha", "lambda", "theta", "phi"})
    arguments = arguments + Arguments{"--set", "table." + axis + ".nodes=" + nodes};
  return arguments;
}

// By default into the working directory, with a checkpoint at every opportunity.
inline Arguments generate(const Arguments& more, const std::string& output = ".",
                          const std::string& checkpoint_seconds = "0.01") {
  return Arguments{"generate", "--output", output, "--checkpoint-seconds", checkpoint_seconds} +
         more;
}

// Half a second of work, most of it in the entries' own fits, some in three sweeps.
inline const Arguments with_sweeps =
    grid_of("3") + Arguments{"--config",  LTCFIT_SOURCE_DIR "/config/reference.toml",
                             "--set",     "fit.gauss_newton.samples=2048",
                             "--set",     "fit.gauss_newton.directions=32",
                             "--set",     "fit.gauss_newton.target_samples=8192",
                             "--threads", "1"};
// Half a second of work by the stochastic solver.
inline const Arguments stochastic =
    grid_of("3") + Arguments{"--config",  LTCFIT_SOURCE_DIR "/config/sgd.toml",
                             "--set",     "fit.sgd.steps=75",
                             "--threads", "1"};
// Sixteen entries in no time, and sixteen that would take hours.
// From fits: those of this grid are few, and there is something to resume.
inline const Arguments tiny =
    grid_of("2") + Arguments{"--set", "fit.gauss_newton.steps=2", "--set", "refine.start=fits"};
inline const Arguments endless =
    grid_of("2") + Arguments{"--config",  LTCFIT_SOURCE_DIR "/config/paper.toml",
                             "--set",     "fit.sgd.steps=10000000",
                             "--threads", "2"};
// Fits of a twentieth of a second each, a quarter of an hour in all: something else ends it,
// however busy the machine.
inline const Arguments lengthy =
    grid_of("12") + Arguments{"--config",  LTCFIT_SOURCE_DIR "/config/sgd.toml",
                              "--set",     "fit.sgd.steps=750",
                              "--threads", "1"};

// All files of a folder; in HDF5, the time of creation blanked.
inline Files files_in(const std::filesystem::path& folder) {
  Files files;
  for (const std::string& name : names_in(folder))
    files[name] = read_file(folder / name);
  if (const auto table = files.find("ltc.h5"); table != files.end()) {
    const std::string created = read_table(folder / "ltc.h5").created;
    const std::size_t place = table->second.find(created);
    EXPECT_FALSE(created.empty());
    EXPECT_NE(place, std::string::npos);
    table->second.replace(place, created.size(), created.size(), ' ');
  }
  return files;
}

// What a run makes that nothing disturbs.
inline Files undisturbed(const Arguments& run) {
  const TemporaryDirectory folder;
  const ProgramResult result = run_ltcfit(generate(run), folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  Files files = files_in(folder.path());
  EXPECT_GE(files.size(), 4u);
  EXPECT_FALSE(files.contains(checkpoint));
  return files;
}

inline void expect_same_files(const Files& files, const Files& expected) {
  for (const auto& [name, bytes] : expected) {
    ASSERT_TRUE(files.contains(name)) << name << " is missing";
    EXPECT_TRUE(files.at(name) == bytes) << name << " differs";
  }
  EXPECT_EQ(files.size(), expected.size());
}

// Waits until the checkpoint has other bytes than the older one; false if the program ended before.
inline bool wait_for_new_checkpoint(RunningProgram& program, const std::filesystem::path& file,
                                    const std::string& older) {
  return program.wait_until(
      [&] { return std::filesystem::exists(file) && read_file(file) != older; }, limit);
}

inline Arguments command(const Arguments& arguments) {
  return Arguments{LTCFIT_PROGRAM} + arguments;
}

// Leaves a checkpoint of the lengthy run in the folder, and its bytes.
inline std::string leave_checkpoint(const std::filesystem::path& folder) {
  RunningProgram program(command(generate(lengthy)), folder);
  EXPECT_TRUE(wait_for_new_checkpoint(program, folder / checkpoint, ""));
  program.send_signal(SIGKILL);
  EXPECT_EQ(program.wait(limit).exit_code, 128 + SIGKILL);
  return read_file(folder / checkpoint);
}

// Tries again where a run of a part of a second was done before this process, on a busy machine,
// got round to disturbing it: that is no trial. Only a program that cannot be disturbed, or a trial
// that disturbs nothing, exhausts the tries.
inline void until_disturbed(const std::function<bool()>& trial) {
  constexpr int most_tries = 100;
  for (int tries = 0; tries < most_tries; ++tries)
    if (trial() || ::testing::Test::HasFailure())
      return;
  FAIL() << "none of " << most_tries << " runs could be disturbed before its end";
}

// As it stood: nothing added, nothing changed.
inline void expect_only(const std::filesystem::path& folder, const Files& expected) {
  Files files;
  for (const std::string& name : names_in(folder))
    files[name] = read_file(folder / name);
  expect_same_files(files, expected);
}

}  // namespace ltc::test::runs
