// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Standard streams that are full, closed or nobody's, through the real program.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/generate_runs.h"

namespace ltc::test {
namespace {

using namespace runs;

const Arguments unrefined = tiny + Arguments{"--set", "refine.steps=0"};

// The program under a shell that redirects its streams.
ProgramResult run_redirected(const Arguments& arguments, const std::string& redirection,
                             const TemporaryDirectory& folder) {
  return run_program(Arguments{"sh", "-c", "\"$@\" " + redirection, "sh"} + command(arguments),
                     folder.path());
}

// One of each command, made short, on a table T.h5.
std::vector<Arguments> one_of_each() {
  return {generate(unrefined, "out"),
          {"fit", "--entry", "1,1,1,1", "--samples", "64"},
          {"diff", "T.h5", "T.h5", "--samples", "64", "--directions", "1", "--queries", "8"},
          {"validate", "T.h5", "--no-quality"},
          {"bench", "--entries", "1", "--settings", "default", "--samples", "64"},
          {"stress", "--solver", "gauss-newton", "--quick", "--fits", "1"},
          {"render", "T.h5", "--size", "8", "--samples", "16", "-o", "spheres"},
          {"completion", "bash"},
          {"man"},
          {"--help"},
          {"--version"}};
}

class Streams : public ::testing::Test {
 protected:
  void SetUp() override {
    const ProgramResult made =
        run_ltcfit(generate(unrefined + Arguments{"--set", "output.name=T"}), folder_.path());
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  TemporaryDirectory folder_;
};

TEST_F(Streams, ProgressThatCannotBeWrittenIsDropped) {
  for (const Arguments& arguments : one_of_each()) {
    SCOPED_TRACE(arguments[0]);
    const ProgramResult plain = run_redirected(arguments, "", folder_);
    for (const std::string redirection : {"2>/dev/full", "2>&-", "<&-", "<&- 2>&-"}) {
      const ProgramResult result = run_redirected(arguments, redirection, folder_);
      EXPECT_EQ(result.exit_code, plain.exit_code) << redirection << ": " << result.err;
      EXPECT_EQ(result.out.empty(), plain.out.empty()) << redirection;
    }
  }
  EXPECT_EQ(read_table(folder_ / "out/ltc.h5").stored, read_table(folder_ / "T.h5").stored);
}

TEST_F(Streams, ResultsThatCannotBeWrittenAreAnError) {
  for (const Arguments& arguments : one_of_each())
    for (const std::string redirection : {">/dev/full", ">&-", "<&- >&-", "| true"}) {
      SCOPED_TRACE(arguments[0] + " " + redirection);
      // The exit code of the program, not of the pipe's reader.
      const bool pipe = redirection == "| true";
      const ProgramResult result = run_program(
          Arguments{
              "bash", "-c",
              pipe ? "mkfifo p; exec 3<>p; exec 4>p; exec 3<&-; \"$@\" >&4; c=$?; rm p; exit $c"
                   : "\"$@\" " + redirection,
              "bash"} +
              command(arguments),
          folder_.path());
      EXPECT_EQ(result.exit_code, 3) << result.err;
      const std::size_t begin = result.err.rfind('\n', result.err.size() - 2) + 1;
      EXPECT_EQ(result.err.find("ltcfit: cannot write to standard output"), begin) << result.err;
    }
  // The table is there still.
  EXPECT_EQ(read_table(folder_ / "out/ltc.h5").stored, read_table(folder_ / "T.h5").stored);
}

TEST_F(Streams, BothClosedIsAnErrorThatNobodyReads) {
  for (const Arguments& arguments : one_of_each())
    EXPECT_EQ(run_redirected(arguments, "<&- >&- 2>&-", folder_).exit_code, 3) << arguments[0];
  EXPECT_EQ(read_table(folder_ / "out/ltc.h5").stored, read_table(folder_ / "T.h5").stored);
}

TEST_F(Streams, JsonTakesThePlaceOfTheTextOnStandardOutput) {
  for (Arguments arguments : one_of_each()) {
    if (arguments[0] == "completion")
      break;
    SCOPED_TRACE(arguments[0]);
    arguments = arguments + Arguments{"--json", "-"};
    const ProgramResult result = run_ltcfit(arguments, folder_.path());
    EXPECT_TRUE(nlohmann::json::accept(result.out)) << result.out.substr(0, 200);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "-"));
    // And a file of its own holds the same keys, beside the text.
    arguments.back() = "all.json";
    const ProgramResult beside = run_ltcfit(arguments, folder_.path());
    EXPECT_EQ(beside.exit_code, result.exit_code);
    EXPECT_FALSE(nlohmann::json::accept(beside.out));
    const auto keys = [](const std::string& text) {
      std::vector<std::string> all;
      const nlohmann::json json = nlohmann::json::parse(text);
      for (const auto& [key, value] : json.items())
        all.push_back(key);
      return all;
    };
    EXPECT_EQ(keys(read_file(folder_ / "all.json")), keys(result.out));
  }
}

}  // namespace
}  // namespace ltc::test
