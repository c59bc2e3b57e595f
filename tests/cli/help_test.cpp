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
    "generate", "fit", "diff", "validate", "bench", "stress", "render", "completion", "man"};

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

// What bash offers for the last of the words.
std::vector<std::string> completed(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words)
    line += " '" + word + "'";
  const ProgramResult result = run_program(
      {"bash", "-c",
       "source <(" LTCFIT_PROGRAM " completion bash); COMP_WORDS=(ltcfit" + line +
           "); COMP_CWORD=" + std::to_string(words.size()) +
           "; _ltcfit; ((${#COMPREPLY[@]})) && printf '%s\\n' \"${COMPREPLY[@]}\"; true"},
      LTCFIT_SOURCE_DIR "/config");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  std::vector<std::string> replies;
  std::istringstream lines(result.out);
  for (std::string reply; std::getline(lines, reply);)
    replies.push_back(reply);
  std::sort(replies.begin(), replies.end());
  return replies;
}

TEST(Completion, OfBashKnowsCommandsOptionsAndValues) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(completed({"gen"}), Words{"generate"});
  EXPECT_EQ(completed({"--v"}), Words{"--version"});
  EXPECT_EQ(completed({"generate", "--che"}), Words{"--checkpoint-seconds"});
  EXPECT_EQ(completed({"fit", "--solver", "s"}), Words{"sgd"});
  EXPECT_EQ(completed({"fit", "--solver", "=", "l"}), Words{"l3-nelder-mead"});
  EXPECT_EQ(completed({"fit", "--solver", "="}), (Words{"gauss-newton", "l3-nelder-mead", "sgd"}));
  EXPECT_EQ(completed({"generate", "--config", "pa"}), Words{"paper.toml"});
  EXPECT_EQ(completed({"generate", "-o", "sc"}), Words{"scenes"});
  EXPECT_EQ(completed({"diff", "pap"}), Words{"paper.toml"});  // the table's argument: files
  EXPECT_EQ(completed({"completion", "f"}), Words{"fish"});
  EXPECT_EQ(completed({"generate", "--threads", ""}), Words{});  // a number: nothing to offer
  EXPECT_EQ(completed({"unknown", ""}), Words{});
  EXPECT_EQ(completed({"man", ""}), (Words{"--help", "-h"}));
}

TEST(Completion, IsReadByItsShell) {
  const TemporaryDirectory folder;
  for (const auto& [shell, check] : {std::pair<std::string, std::string>{"bash", "-n"},
                                     {"zsh", "-n"},
                                     {"fish", "--no-execute"}}) {
    const ProgramResult script = run_ltcfit({"completion", shell});
    ASSERT_EQ(script.exit_code, 0);
    for (const std::string& command : all_commands)
      EXPECT_NE(script.out.find(command), std::string::npos) << shell << ": " << command;
    const std::string file = folder.write("script." + shell, script.out).string();
    if (run_program({"sh", "-c", "command -v " + shell}).exit_code != 0)
      continue;
    const ProgramResult result = run_program({shell, check, file});
    EXPECT_EQ(result.exit_code, 0) << shell << ": " << result.err;
    EXPECT_EQ(result.err, "") << shell;
  }
}

}  // namespace
}  // namespace ltc::test
