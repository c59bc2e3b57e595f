// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit bench, through the real program.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "export/table_file.h"
#include "picture/png.h"
#include "support/program.h"
#include "table/synthetic.h"

namespace ltc::test {
namespace {

// A few fits, judged by few samples.
std::vector<std::string> bench(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"bench",     "--entries",  "6",
                                        "--samples", "512",        "--directions",
                                        "8",         "--settings", "gn-256x16,default"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

void expect_refused(const std::vector<std::string>& arguments, int exit_code,
                    const std::vector<std::string>& parts) {
  const TemporaryDirectory folder;
  const ProgramResult result = run_ltcfit(arguments, folder.path());
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  for (const std::string& part : parts)
    EXPECT_NE(result.err.find(part), std::string::npos)
        << '"' << part << "\" is not in: " << result.err;
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{});
}

TEST(Bench, TellsTimesAndErrorsAndWritesTheFiles) {
  const TemporaryDirectory folder;
  const ProgramResult result = run_ltcfit(
      bench({"--json", "b.json", "--csv", "b.csv", "--picture", "b.png"}), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"6 of the ", "8x8x8x8", "one core", "\ngn-256x16 ", "\ndefault "})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " is not in:\n" << result.out;
  EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"b.csv", "b.json", "b.png"}));

  const auto json = nlohmann::json::parse(read_file(folder / "b.json"));
  ASSERT_EQ(json["settings"].size(), 2u);
  for (const auto& setting : json["settings"]) {
    EXPECT_GT(setting["milliseconds_mean"], 0);
    EXPECT_GE(setting["ratio_mean"], 1);  // the best of both is 1
    EXPECT_GE(setting["ratio_worst"], setting["ratio_mean"]);
    EXPECT_EQ(setting["failures"], 0);
  }
  const std::string csv = read_file(folder / "b.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
  const picture::test::DecodedPng png = picture::test::decode_png(read_file(folder / "b.png"));
  EXPECT_EQ(png.width, 1600);
  EXPECT_GT(std::count_if(png.rgb.begin(), png.rgb.end(), [](int byte) { return byte < 128; }),
            1000);  // something is drawn
}

TEST(Bench, MeasuresTheUsersConfigToo) {
  const ProgramResult result =
      run_ltcfit({"bench", "--entries", "2", "--samples", "512", "--directions", "8", "--settings",
                  "config", "--set", "fit.gauss_newton.samples=128", "--set", "table.phi.nodes=3"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("\nconfig "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("8x8x8x3"), std::string::npos) << result.out;
}

TEST(Bench, SaysHowSgdWasExtrapolated) {
  const ProgramResult result =
      run_ltcfit({"bench", "--entries", "1", "--samples", "512", "--directions", "8", "--settings",
                  "default,sgd-published"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"extrapolated from 8 timed steps of 10000", "no error without",
                           "times faster per entry than sgd-published"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " is not in:\n" << result.out;
}

TEST(Bench, WarnsOfAReferenceThatIsRefined) {
  const test::TemporaryDirectory folder;
  Table table = testing::synthetic_table(Grid::paper(8), Storage::matrix);
  for (const bool refined : {true, false}) {
    table.refined = refined;
    write_table(table, folder / "r.h5");
    const ProgramResult result =
        run_ltcfit({"bench", "--entries", "1", "--samples", "512", "--directions", "8",
                    "--settings", "gn-256x16", "--reference", "r.h5"},
                   folder.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err.find("r.h5 is refined") != std::string::npos, refined) << result.err;
  }
}

TEST(Bench, NamesTheTableOfAnotherGrid) {
  const test::TemporaryDirectory folder;
  const std::string table = (folder / "other.h5").string();
  write_table(testing::synthetic_table(Grid::paper(2), Storage::matrix), table);
  for (const char* option : {"--reference", "--published"})
    expect_refused({"bench", "--entries", "1", option, table}, 2,
                   {"other.h5", "2x2x2x2 and 8x8x8x8"});
}

TEST(Bench, RefusesBadInputInOneLine) {
  expect_refused(bench({"--settings", "fast"}), 2, {"--settings"});
  expect_refused({"bench", "--settings", "fast"}, 2, {"\"fast\"", "default", "sgd-published"});
  expect_refused({"bench", "--settings", "config"}, 2, {"\"config\""});
  expect_refused({"bench", "--entries", "0"}, 2, {"--entries"});
  expect_refused({"bench", "--entries", "x"}, 2, {"--entries"});
  expect_refused({"bench", "--entries", "4", "--all"}, 2, {"--all"});
  expect_refused({"bench", "--full-sgd", "1", "--published", "x.npy"}, 2, {"--full-sgd"});
  expect_refused({"bench", "--published", "x.txt"}, 2, {"x.txt", ".npy"});
  expect_refused({"bench", "--reference", "none.h5"}, 3, {"none.h5"});
  expect_refused({"bench", "--set", "fit.solver=newton"}, 2, {"fit.solver", "l3-nelder-mead"});
}

TEST(Bench, RefusesFilesThatItCannotWriteBeforeItMeasures) {
  expect_refused(bench({"--json", "none/b.json"}), 3, {"none/b.json", "no folder"});
  expect_refused(bench({"--picture", "."}), 3, {"folder"});
  expect_refused(bench({"--json", "b", "--csv", "./b"}), 2,
                 {"--csv ./b is the same file as --json b"});
}

}  // namespace
}  // namespace ltc::test
