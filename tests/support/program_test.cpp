// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The tests' own helpers: a helper that cannot see a failure would hide one.
#include "support/program.h"

#include <gtest/gtest.h>
#include <signal.h>

namespace ltc::test {
namespace {

TEST(TemporaryDirectory, IsRemovedWithItsContent) {
  std::filesystem::path path;
  {
    const TemporaryDirectory folder;
    path = folder.path();
    EXPECT_EQ(read_file(folder.write("b", "text")), "text");
    folder.write(".hidden", "");
    EXPECT_EQ(names_in(path), (std::vector<std::string>{".hidden", "b"}));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(RunProgram, ReportsOutputsExitCodeAndFolder) {
  const TemporaryDirectory folder;
  const ProgramResult result =
      run_program({"sh", "-c", "echo out; echo err >&2; touch here; exit 7"}, folder.path());
  EXPECT_EQ(result.exit_code, 7);
  EXPECT_EQ(result.out, "out\n");
  EXPECT_EQ(result.err, "err\n");
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"here"});
}

TEST(RunProgram, RefusesAProgramThatIsNotThere) {
  EXPECT_THROW(run_program({"/nonexistent/program"}), std::runtime_error);
}

TEST(RunningProgram, SeesTextAndSignals) {
  RunningProgram program({"sh", "-c", "echo ready >&2; exec sleep 100"});
  ASSERT_TRUE(program.wait_for_error_text("ready", patience));
  program.send_signal(SIGTERM);
  EXPECT_EQ(program.wait(patience).exit_code, 128 + SIGTERM);
}

TEST(RunningProgram, SaysWhenTheTextNeverCame) {
  RunningProgram program({"true"});
  EXPECT_FALSE(program.wait_for_error_text("ready", patience));
}

TEST(RunningProgram, KillsWhatRunsTooLong) {
  RunningProgram program({"sleep", "100"});
  EXPECT_EQ(program.wait(std::chrono::seconds(0)).exit_code, 128 + SIGKILL);
}

}  // namespace
}  // namespace ltc::test
