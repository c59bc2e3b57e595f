// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The program as a whole: help, version, usage errors.
#include <gtest/gtest.h>

#include "core/version.h"
#include "support/program.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

void expect_contains(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << '"' << part << "\" is not in: " << text;
}

TEST(Program, HelpGoesToStandardOutput) {
  for (const char* flag : {"--help", "-h"}) {
    const ProgramResult result = run_ltcfit({flag});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    expect_contains(result.out, {"Usage: ltcfit COMMAND", "Make a table:", "generate", "--version",
                                 "Exit codes:", "130"});
  }
}

TEST(Program, HelpOfACommandNamesDefaults) {
  const ProgramResult result = run_ltcfit({"generate", "--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  expect_contains(result.out, {"Usage: ltcfit generate", "--config", "--set", "--output", "[out]",
                               "--threads", "What to fit:", "What to write:"});
}

TEST(Program, VersionNamesTheCommit) {
  const ProgramResult result = run_ltcfit({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, generator() + "\n");
  EXPECT_EQ(result.out.find("ltcfit " + std::string(version()) + " ("), 0u);
}

TEST(Program, UsageErrorsAreOneLine) {
  const auto expect_usage_error = [](const std::vector<std::string>& arguments,
                                     const std::vector<std::string>& parts) {
    const ProgramResult result = run_ltcfit(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
    expect_contains(result.err, parts);
  };
  expect_usage_error({}, {"no command", "generate", "--help"});
  expect_usage_error({"genrate"}, {"unknown command genrate", "generate"});
  expect_usage_error({"gen\nrate"}, {"unknown command", "gen\\nrate"});
  expect_usage_error({""}, {"unknown command ''"});
  expect_usage_error({"--colour"}, {"--colour", "--help"});
}

TEST(Program, OutputThatDoesNotArriveIsAnError) {
  const ProgramResult result =
      run_program({"sh", "-c", std::string(LTCFIT_PROGRAM) + " --help > /dev/full"});
  EXPECT_EQ(result.exit_code, 3);
  expect_contains(result.err, {"standard output"});
}

}  // namespace
}  // namespace ltc::test
