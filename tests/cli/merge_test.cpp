// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Shards of a table's fits, and what becomes of them: the files of a plain run, or the names of
// those that are at fault.
#include <gtest/gtest.h>
#include <signal.h>

#include "support/generate_runs.h"
#include "support/refused_run.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using namespace runs;

const Arguments quick = tiny + Arguments{"--set", "refine.queries_per_cell=16",
                                         "--set", "refine.held_out_queries=100",
                                         "--set", "refine.steps=2"};

std::string name_of(int number, int count) {
  return "ltc.shard-" + std::to_string(number) + "-of-" + std::to_string(count) + ".h5";
}

ProgramResult make_shard(const Arguments& run, int number, int count, const fs::path& folder) {
  return run_ltcfit(
      generate(run + Arguments{"--shard", std::to_string(number) + "/" + std::to_string(count)}),
      folder);
}

Arguments all_of(int count) {
  Arguments names;
  for (int number = 1; number <= count; ++number)
    names.push_back(name_of(number, count));
  return names;
}

ProgramResult merge(const Arguments& shards, const fs::path& folder, const Arguments& more = {}) {
  return run_ltcfit(Arguments{"merge"} + shards + Arguments{"--output", "merged"} + more, folder);
}

void expect_merged_as_plain(const Arguments& run) {
  const TemporaryDirectory folder;
  for (const int number : {2, 3, 1}) {
    const ProgramResult made = make_shard(run, number, 3, folder.path());
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_NE(made.out.find(name_of(number, 3)), std::string::npos) << made.out;
  }
  EXPECT_EQ(names_in(folder.path()), all_of(3));
  const ProgramResult merged = merge(all_of(3), folder.path());
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_NE(merged.out.find("wrote    merged/ltc.h5"), std::string::npos) << merged.out;
  expect_same_files(files_in(folder / "merged"), undisturbed(run));
}

TEST(Merge, ThreeOfThreeAreThePlainRun) {
  expect_merged_as_plain(quick);
}

// Sweeps need the fits of all, and are made once they are together.
TEST(Merge, SweepsAreMadeOfAllShards) {
  expect_merged_as_plain(with_sweeps + Arguments{"--set", "refine.steps=0"});
}

TEST(Merge, OutputMayBeAnotherThanTheShards) {
  const TemporaryDirectory folder;
  ASSERT_EQ(make_shard(quick, 1, 1, folder.path()).exit_code, 0);
  const ProgramResult merged =
      merge(all_of(1), folder.path(), {"--set", "output.npy=false", "--set", "output.name=b"});
  EXPECT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(names_in(folder / "merged"), (Arguments{"b.0.exr", "b.1.exr", "b.2.exr", "b.h5"}));
}

TEST(Merge, NamesEachThatIsAtFault) {
  const TemporaryDirectory folder;
  for (const int number : {1, 2, 4})
    ASSERT_EQ(make_shard(quick, number, 5, folder.path()).exit_code, 0);
  expect_error(merge({name_of(1, 5), name_of(2, 5), name_of(2, 5)}, folder.path()), 2,
               {"shard 2 of 5 is there twice", "shards 3 to 5 of 5 are missing"});
  expect_error(merge({name_of(1, 5), name_of(2, 5), name_of(4, 5)}, folder.path()), 2,
               {"shard 3 of 5 is missing", "shard 5 of 5 is missing"});
  ASSERT_EQ(make_shard(quick, 1, 2, folder.path()).exit_code, 0);
  ASSERT_EQ(make_shard(quick + Arguments{"--set", "fit.gauss_newton.steps=3"}, 2, 2, folder.path())
                .exit_code,
            0);
  expect_error(merge(all_of(2), folder.path()), 2,
               {name_of(2, 2) + " was made with fit.gauss_newton.steps = 3; expected 2"});
  expect_error(merge({name_of(1, 2), name_of(1, 5)}, folder.path()), 2,
               {name_of(1, 5) + " is of 5 shards", "shard 2 of 2 is missing"});
  expect_error(merge({name_of(1, 2), "none.h5"}, folder.path()), 3, {"none.h5"});
  folder.write("text.h5", "no shard");
  expect_error(merge({name_of(1, 2), "text.h5"}, folder.path()), 2,
               {"text.h5", "shard 2 of 2 is missing"});
  EXPECT_FALSE(fs::exists(folder / "merged"));
}

TEST(Merge, OfOtherEntriesIsRefused) {
  const TemporaryDirectory folder;
  const std::string scene = LTCFIT_SOURCE_DIR "/config/scenes/isotropic-game.toml";
  ASSERT_EQ(make_shard(quick + Arguments{"--scene", scene}, 1, 1, folder.path()).exit_code, 0);
  expect_error(merge(all_of(1), folder.path()), 2, {name_of(1, 1), "made for other entries"});
  EXPECT_EQ(merge(all_of(1), folder.path(), {"--scene", scene}).exit_code, 0);
}

// A shard that was killed is named, and another of its runs goes on with it.
TEST(Shard, KilledIsIncompleteAndGoesOn) {
  until_disturbed([] {
    const TemporaryDirectory folder;
    const Arguments shard = generate(stochastic + Arguments{"--shard", "1/2"});
    {
      RunningProgram program(command(shard), folder.path());
      wait_for_new_checkpoint(program, folder / name_of(1, 2), "");
      program.send_signal(SIGKILL);
      if (program.wait(limit).exit_code == 0)
        return false;
    }
    const ProgramResult broken = merge({name_of(1, 2)}, folder.path());
    if (broken.err.find("incomplete") == std::string::npos)
      return false;  // killed after its last fit
    expect_error(broken, 2,
                 {"shard 2 of 2 is missing", "shard 1 of 2 is incomplete, ",
                  " fits: ", name_of(1, 2), "--resume"});
    expect_error(run_ltcfit(shard, folder.path()), 2, {name_of(1, 2), "--resume", "remove it"});
    const ProgramResult resumed = run_ltcfit(shard + Arguments{"--resume"}, folder.path());
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(make_shard(stochastic, 2, 2, folder.path()).exit_code, 0);
    EXPECT_EQ(merge(all_of(2), folder.path()).exit_code, 0);
    expect_same_files(files_in(folder / "merged"), undisturbed(stochastic));
    return true;
  });
}

TEST(Shard, OneOfOtherFitsIsNotResumed) {
  const TemporaryDirectory folder;
  ASSERT_EQ(make_shard(quick, 1, 2, folder.path()).exit_code, 0);
  fs::rename(folder / name_of(1, 2), folder / name_of(2, 2));
  expect_error(make_shard(quick + Arguments{"--resume"}, 2, 2, folder.path()), 2,
               {name_of(2, 2), "of shard 1 of 2; expected 2 of 2"});
  fs::rename(folder / name_of(2, 2), folder / checkpoint);
  expect_error(run_ltcfit(generate(quick + Arguments{"--resume"}), folder.path()), 2,
               {checkpoint, "ltc-shard", "ltc-checkpoint"});
}

TEST(Shard, SeveralMayWorkInAFolder) {
  const TemporaryDirectory folder;
  RunningProgram first(command(generate(lengthy + Arguments{"--shard", "1/2"})), folder.path());
  ASSERT_TRUE(wait_for_new_checkpoint(first, folder / name_of(1, 2), ""));
  EXPECT_EQ(make_shard(quick, 2, 2, folder.path()).exit_code, 0);
  const ProgramResult whole = run_ltcfit(generate(quick), folder.path());
  EXPECT_EQ(whole.exit_code, 3);
  EXPECT_NE(whole.err.find("another run is working"), std::string::npos) << whole.err;
}

TEST(Shard, MoreThanFitsHaveNothingToDo) {
  const TemporaryDirectory folder;
  const ProgramResult made = make_shard(quick, 90000, 100000, folder.path());
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find(": 0 fits"), std::string::npos) << made.out;
}

TEST(Shard, TellsItsResultsAsJson) {
  const TemporaryDirectory folder;
  const ProgramResult made = make_shard(quick + Arguments{"--json", "-"}, 1, 2, folder.path());
  const auto json = nlohmann::json::parse(made.out);
  EXPECT_EQ(json["shard"], 1);
  EXPECT_EQ(json["shards"], 2);
  EXPECT_EQ(json["files"][0], "./" + name_of(1, 2));
  EXPECT_GT(json["fits"], 0);
}

TEST(Shard, WhatHasNoFitsIsRefused) {
  expect_refused({"generate", "--shard", "1/2", "--config", LTCFIT_SOURCE_DIR "/config/field.toml"},
                 2, {"a field has no fits", "ranks", "mpirun"});
  expect_refused(
      {"generate", "--shard", "1/2", "--config", LTCFIT_SOURCE_DIR "/config/folded.toml"}, 2,
      {"a folded table has no fits"});
  for (const char* shard : {"0/2", "3/2", "1", "1/", "/2", "1/2/3", "1/200000", "-1/2", "a/b", ""})
    expect_refused({"generate", "--shard", shard}, 2, {"--shard", shard, "I/N"});
}

}  // namespace
}  // namespace ltc::test
