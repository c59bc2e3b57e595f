// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Help, manual page and completion, all made from the tables of options.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "cli/wrap.h"
#include "support/program.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

const std::vector<std::string> all_commands = {
    "generate", "fit",     "diff",   "validate",  "bench",      "stress", "render",
    "view",     "convert", "lookup", "prefilter", "completion", "man"};

TEST(Wrap, BreaksBetweenWordsAlone) {
  EXPECT_EQ(cli::wrapped("a bb ccc", 80, 0, 0), "a bb ccc");
  EXPECT_EQ(cli::wrapped("a bb ccc", 4, 0, 0), "a bb\nccc");
  EXPECT_EQ(cli::wrapped("a bb ccc", 5, 2, 1), "a\n bb\n ccc");
  EXPECT_EQ(cli::wrapped("longer than four", 4, 0, 0), "longer\nthan\nfour");
  EXPECT_EQ(cli::wrapped("\xce\xb1 \xce\xb2 c", 3, 0, 0),
            "\xce\xb1 \xce\xb2\nc");  // two bytes, one column
  EXPECT_EQ(cli::wrapped("", 4, 0, 0), "");
}

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);)
    longest = std::max(longest, line.size());
  return longest;
}

TEST(Help, NamesEveryCommandAndFitsTheTerminal) {
  const std::string help = run_ltcfit({"--help"}).out;
  EXPECT_LE(longest_line(help), 80u);  // no terminal: as one of 80 columns
  for (const std::string& command : all_commands) {
    EXPECT_NE(help.find("\n  " + command + " "), std::string::npos) << command;
    const ProgramResult result = run_ltcfit({command, "--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_LE(longest_line(result.out), 80u) << result.out;
    EXPECT_NE(result.out.find("Usage: ltcfit " + command + " [OPTION]..."), std::string::npos);
    // Every option stands in a group that says what it is for.
    EXPECT_EQ(result.out.find("\nOptions:"), std::string::npos) << result.out;
  }
  EXPECT_NE(run_ltcfit({"diff", "-h"}).out.find("Usage: ltcfit diff [OPTION]... A B\n"),
            std::string::npos);
  EXPECT_NE(run_ltcfit({"view", "-h"}).out.find("[OPTION]... TABLE [TABLE_B]\n"),
            std::string::npos);
}

// A terminal of its own, so many columns wide.
TEST(Help, FitsANarrowTerminal) {
  for (const int columns : {60, 100}) {
    const std::string set = "stty cols " + std::to_string(columns) + "; ";
    const ProgramResult result =
        run_program({"script", "-qec", set + LTCFIT_PROGRAM " generate --help", "/dev/null"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::string text = result.out;
    std::erase(text, '\r');
    EXPECT_LE(longest_line(text), static_cast<std::size_t>(columns));
    EXPECT_GT(longest_line(text), static_cast<std::size_t>(columns) - 10);
  }
}

TEST(Man, IsAPageThatGroffTakesWithoutAWarning) {
  const ProgramResult page = run_ltcfit({"man"});
  ASSERT_EQ(page.exit_code, 0);
  for (const std::string& command : all_commands)
    EXPECT_NE(page.out.find(".SH \"LTCFIT " + command + "\""), std::string::npos) << command;
  EXPECT_NE(page.out.find("\\-\\-checkpoint\\-seconds S"), std::string::npos);
  const TemporaryDirectory folder;
  const std::string file = folder.write("ltcfit.1", page.out).string();
  if (run_program({"sh", "-c", "command -v groff"}).exit_code != 0)
    GTEST_SKIP() << "no groff";
  const ProgramResult shown = run_program({"groff", "-man", "-Tutf8", "-ww", "-z", file});
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_EQ(shown.err, "");
}

}  // namespace
}  // namespace ltc::test
