// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/output.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/program.h"

namespace ltc::cli {
namespace {

namespace fs = std::filesystem;
using test::names_in;
using test::TemporaryDirectory;

TEST(Output, MessagesStayOnOneLine) {
  EXPECT_EQ(one_line("a\nb\tc\x1b[0m é"), "a\\nb\\x09c\\x1b[0m é");
}

TEST(Output, QuotedArgumentsReachTheProgramUnchanged) {
  EXPECT_EQ(shell_quoted("fit.seed=2"), "fit.seed=2");
  for (const std::string argument : {"", "a b", "it's", "\"x\"", "$HOME", "*", "a\nb", "\\"})
    EXPECT_EQ(test::run_program({"sh", "-c", "printf %s " + shell_quoted(argument)}).out, argument);
}

TEST(OutputFolder, UnusedIsRemovedWithItsParents) {
  const TemporaryDirectory folder;
  for (const char* name : {"a/b/c", "a/b/c/", "./a/../d", "e"}) {
    {
      const OutputFolder output(folder / name);
      EXPECT_TRUE(fs::is_directory(output.path())) << name;
    }
    // "./a/../d" needs a to exist, on the way; nothing of it may stay either.
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{}) << name;
  }
}

TEST(OutputFolder, UsedOrOlderStays) {
  const TemporaryDirectory folder;
  fs::create_directory(folder / "old");
  { const OutputFolder output(folder / "old"); }
  {
    const OutputFolder output(folder / "new");
    folder.write("new/file", "");
  }
  EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"new", "old"}));
}

TEST(OutputFolder, RefusedLeavesNothing) {
  const TemporaryDirectory folder;
  const fs::path file = folder.write("file", "");
  EXPECT_THROW(OutputFolder{file}, IoError);
  EXPECT_THROW(OutputFolder{file / "below"}, IoError);
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"file"});
}

}  // namespace
}  // namespace ltc::cli
