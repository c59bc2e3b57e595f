// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit generate, through the real program: what it writes, refuses and leaves behind.
#include <gtest/gtest.h>
#include <signal.h>

#include "export/table_file.h"
#include "support/refused_run.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;

// A table of sixteen entries in the least time.
const std::vector<std::string> tiny = {
    "--set", "table.alpha.nodes=2",      "--set", "table.lambda.nodes=2",
    "--set", "table.theta.nodes=2",      "--set", "table.phi.nodes=2",
    "--set", "fit.gauss_newton.steps=2", "--set", "fit.gauss_newton.starts=1"};

std::vector<std::string> generate(std::vector<std::string> more, bool small = true) {
  std::vector<std::string> arguments = {"generate", "--set", "refine.steps=0"};
  if (small)
    arguments.insert(arguments.end(), tiny.begin(), tiny.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// ---- What it writes ----

TEST(Generate, WritesTheFilesAndTellsOfThem) {
  const TemporaryDirectory folder;
  const ProgramResult result = run_ltcfit(generate({}), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"out"});
  const std::vector<std::string> files = {"ltc.0.exr", "ltc.1.exr", "ltc.2.exr", "ltc.h5",
                                          "ltc.npy"};
  EXPECT_EQ(names_in(folder / "out"), files);
  for (const std::string& file : files)
    EXPECT_NE(result.out.find("wrote    out/" + file + "\n"), std::string::npos) << result.out;
  for (const char* part : {"time  ", "memory  ", "entries  16: ", "loss  ", "symmetry ", "worst  ",
                           " --set table.alpha.nodes=2 "})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " is not in: " << result.out;
  EXPECT_NE(result.out.find("ltcfit fit "), std::string::npos);
  EXPECT_NE(result.out.find(" --entry "), std::string::npos);
}

TEST(Generate, WritesOnlyWhatTheConfigAsksFor) {
  const TemporaryDirectory folder;
  const ProgramResult result =
      run_ltcfit(generate({"--output", "a/b", "--set", "output.exr=false", "--set",
                           "output.hdf5=false", "--set", "output.name=mine"}),
                 folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in(folder / "a/b"), std::vector<std::string>{"mine.npy"});
}

TEST(Generate, ReplacesAnOlderTable) {
  const TemporaryDirectory folder;
  folder.write("ltc.npy", "old");
  const ProgramResult result =
      run_ltcfit(generate({"--output", folder.path().string()}), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(read_file(folder / "ltc.npy"), "old");
}

// Files of one name are of one table: what a run does not write is not left of another.
TEST(Generate, RemovesFilesOfAnOlderTable) {
  const TemporaryDirectory folder;
  ASSERT_EQ(run_ltcfit(generate({}), folder.path()).exit_code, 0);
  folder.write("out/other.npy", "of another name");
  // On other axes there is no .npy, and textures are not asked for.
  const std::vector<std::string> others = {"--set", "table.alpha.first=0.1", "--set",
                                           "output.exr=false"};
  const ProgramResult result = run_ltcfit(generate(others), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in(folder / "out"), (std::vector<std::string>{"ltc.h5", "other.npy"}));
  for (const char* name : {"ltc.npy", "ltc.0.exr", "ltc.1.exr", "ltc.2.exr"})
    EXPECT_NE(result.out.find(std::string("removed  out/") + name + ": of an older table\n"),
              std::string::npos)
        << result.out;
  // Nothing is left to remove.
  EXPECT_EQ(run_ltcfit(generate(others), folder.path()).out.find("removed"), std::string::npos);
}

TEST(Generate, DoesNotRemoveWhatItReads) {
  const TemporaryDirectory folder;
  ASSERT_EQ(run_ltcfit(generate({}), folder.path()).exit_code, 0);
  const std::vector<std::string> before = names_in(folder / "out");
  for (const char* input : {"--extend", "--config"})
    expect_error(
        run_ltcfit(generate({input, "out/ltc.h5", "--set", "output.hdf5=false"}), folder.path()), 2,
        {"out/ltc.h5", "would be removed", "output.name"});
  EXPECT_EQ(names_in(folder / "out"), before);
}

TEST(Generate, MakesTheSameBytesAgainAtAGivenTime) {
  const TemporaryDirectory folder;
  const auto made_at = [&](const std::string& seconds, const std::string& output) {
    std::vector<std::string> command = {"env", "SOURCE_DATE_EPOCH=" + seconds, LTCFIT_PROGRAM};
    const std::vector<std::string> arguments = generate({"--output", output});
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run_program(command, folder.path());
  };
  ASSERT_EQ(made_at("1700000000", "a").exit_code, 0);
  ASSERT_EQ(made_at("1700000000", "b").exit_code, 0);
  ASSERT_EQ(made_at("1700000001", "c").exit_code, 0);
  EXPECT_EQ(read_file(folder / "a/ltc.h5"), read_file(folder / "b/ltc.h5"));
  EXPECT_NE(read_file(folder / "a/ltc.h5"), read_file(folder / "c/ltc.h5"));
  EXPECT_EQ(read_table(folder / "a/ltc.h5").created, "2023-11-14T22:13:20Z");
  for (const char* seconds : {"", "now", "1.5", "-1", "253402300800", "99999999999999999999"})
    expect_error(made_at(seconds, "d"), 2, {"SOURCE_DATE_EPOCH", seconds, "[0, 253402300799]"});
  EXPECT_FALSE(fs::exists(folder / "d"));
}

TEST(Generate, TellsWhat16BitsCost) {
  const TemporaryDirectory folder;
  const ProgramResult result =
      run_ltcfit(generate({"--set", "output.exr_half=true"}), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("half     16 bits "), std::string::npos) << result.out;
  EXPECT_EQ(run_ltcfit(generate({}), folder.path()).out.find("half  "), std::string::npos);
}

TEST(Generate, ProgressStaysPlainWhereThereIsNoTerminal) {
  const TemporaryDirectory folder;
  const ProgramResult result = run_ltcfit(generate({}), folder.path());
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err.find_first_of("\r\033"), std::string::npos) << result.err;
}

// ---- What it refuses ----

TEST(GenerateBadInput, UnknownKey) {
  expect_refused(generate({"--set", "fit.stepz=3"}), 2,
                 {"--set", "fit.stepz", "3", "did you mean"});
}

TEST(GenerateBadInput, WrongType) {
  expect_refused(generate({"--set", "fit.seed=soon"}), 2,
                 {"--set", "fit.seed", "\"soon\"", "whole number in [0, "});
}

TEST(GenerateBadInput, ValueOutOfRange) {
  expect_refused(generate({"--set", "table.alpha.nodes=0"}), 2,
                 {"--set", "table.alpha.nodes = 0", "[1, 64]"});
}

TEST(GenerateBadInput, ConfigFile) {
  const TemporaryDirectory configs;
  const auto expect_config_refused = [&](std::string_view text, const std::string& line,
                                         std::vector<std::string> parts) {
    const fs::path file = configs.write("bad.toml", text);
    parts.push_back(file.string() + ":" + line + ": ");
    expect_refused({"generate", "--config", file.string()}, 2, parts);
  };
  expect_config_refused(
      "[fit]\nsolver = \"newton\"\n", "2",
      {"fit.solver = \"newton\"", "\"gauss-newton\", \"sgd\" or \"l3-nelder-mead\""});
  expect_config_refused("[fit]\nseeds = 1\n", "2", {"unknown key fit.seeds = 1", "fit.seed?"});
  expect_config_refused("[fit]\nseed = \"1\"\n", "2", {"fit.seed = \"1\"", "whole number"});
  expect_config_refused("[fit]\nseed = -1\n", "2", {"fit.seed = -1", "[0, "});
  expect_config_refused("[fit\nseed = 1\n", "1", {"not TOML"});
  expect_config_refused("\"a\\nb\" = 1\n", "1", {"unknown key a\\nb"});
}

TEST(GenerateBadInput, MissingConfig) {
  expect_refused(generate({"--config", "none.toml"}), 3, {"none.toml", "No such file"});
}

TEST(GenerateBadInput, UnreadableConfig) {
  // A folder: unreadable as a file even to root.
  expect_refused(generate({"--config", "/"}), 3, {"config /: ", "folder", "expected a file"});
}

TEST(GenerateBadInput, OutputThatIsAFile) {
  const TemporaryDirectory folder;
  const fs::path file = folder.write("taken", "content");
  expect_refused(generate({"--output", file.string()}), 3, {file.string(), "is a file", "folder"});
  EXPECT_EQ(read_file(file), "content");
}

TEST(GenerateBadInput, OutputThatCannotBeMade) {
  const TemporaryDirectory folder;
  const fs::path file = folder.write("taken", "content");
  expect_refused(generate({"--output", (file / "below").string()}), 3, {(file / "below").string()});
  expect_refused(generate({"--output", "/proc/nonexistent/below"}), 3, {"/proc/nonexistent/below"});
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"taken"});
}

TEST(GenerateBadInput, FileThatIsAFolder) {
  const TemporaryDirectory folder;
  fs::create_directories(folder / "out/ltc.npy");
  expect_error(run_ltcfit(generate({}), folder.path()), 3, {"out/ltc.npy", "is a folder"});
  EXPECT_EQ(names_in(folder / "out"), std::vector<std::string>{"ltc.npy"});
}

TEST(GenerateBadInput, Threads) {
  for (const char* threads : {"0", "-1", "1025", "two", "1.5", "", "99999999999999"})
    expect_refused(generate({"--threads", threads}), 2, {"--threads", threads, "[1, 1024]"});
}

TEST(GenerateBadInput, Usage) {
  expect_refused({"generate", "--colour"}, 2, {"--colour", "--help"});
  expect_refused({"generate", "extra"}, 2, {"extra", "--help"});
  expect_refused({"generate", "--config"}, 2, {"--config"});
  expect_refused({"generate", "--config", ""}, 2, {"--config"});
  expect_refused({"generate", "--output", ""}, 2, {"--output"});
  expect_refused({"generate", "--set", "fit.seed"}, 2, {"--set", "fit.seed", "key=value"});
}

// ---- What an interrupt leaves ----

// The command for sixteen entries that would take hours, whatever the machine.
std::vector<std::string> endless(const std::string& output) {
  std::vector<std::string> command =
      generate({"--config", LTCFIT_SOURCE_DIR "/config/paper.toml", "--set",
                "fit.sgd.steps=10000000", "--threads", "2", "--output", output});
  command.insert(command.begin(), LTCFIT_PROGRAM);
  return command;
}

// Without a way to stop, the fit would go on for hours.
TEST(GenerateInterrupt, EndsSoonAndLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryDirectory folder;
    RunningProgram program(endless("a/b"), folder.path());
    ASSERT_TRUE(program.wait_for_error_text("fit: ", patience));
    program.send_signal(signal);
    const ProgramResult result = program.wait(patience);
    EXPECT_EQ(result.exit_code, 130);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.err.ends_with("ltcfit: interrupted; nothing was written\n")) << result.err;
    EXPECT_NE(result.err.find("\nfit: stopped after "), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("done"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("\nfit: stopped after "), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("done"), std::string::npos) << result.err;
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{});
  }
}

// As nohup starts it: the terminal's end is not its own.
TEST(GenerateInterrupt, IgnoresWhatItWasStartedToIgnore) {
  const TemporaryDirectory folder;
  const std::vector<std::string> command = endless("a");
  std::vector<std::string> ignoring = {"sh", "-c", "trap '' HUP; exec \"$@\"", "sh"};
  ignoring.insert(ignoring.end(), command.begin(), command.end());
  RunningProgram program(ignoring, folder.path());
  ASSERT_TRUE(program.wait_for_error_text("fit: ", patience));
  program.send_signal(SIGHUP);
  program.send_signal(SIGTERM);  // the one that ends it
  EXPECT_EQ(program.wait(patience).exit_code, 130);
}

TEST(GenerateInterrupt, KeepsAnOlderTable) {
  const TemporaryDirectory folder;
  folder.write("ltc.npy", "old");
  RunningProgram program(endless(folder.path().string()));
  ASSERT_TRUE(program.wait_for_error_text("fit: ", patience));
  program.send_signal(SIGINT);
  EXPECT_EQ(program.wait(patience).exit_code, 130);
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"ltc.npy"});
  EXPECT_EQ(read_file(folder / "ltc.npy"), "old");
}

}  // namespace
}  // namespace ltc::test
