// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables with one node along phi, through the real program.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/refused_run.h"

namespace ltc::test {
namespace {

using Arguments = std::vector<std::string>;

Arguments generate(const Arguments& settings) {
  Arguments arguments = {"generate", "-o", "t"};
  for (const std::string setting :
       {"table.alpha.nodes=5", "table.theta.nodes=5", "table.phi.nodes=1", "output.exr=false"})
    arguments.insert(arguments.end(), {"--set", setting});
  for (const std::string& setting : settings)
    arguments.insert(arguments.end(), {"--set", setting});
  return arguments;
}

Arguments validate(const Arguments& settings) {
  Arguments arguments = {"validate", "t/ltc.h5", "--json", "t.json"};
  for (const std::string setting :
       {"quality.queries=40", "quality.query_samples=1024", "quality.query_directions=8",
        "quality.node_samples=1024", "quality.node_directions=8", "quality.quads=4",
        "quality.quad_samples=1024", "quality.node_loss=1", "invariants.neighbour_excess=1e3"})
    arguments.insert(arguments.end(), {"--set", setting});
  for (const std::string& setting : settings)
    arguments.insert(arguments.end(), {"--set", setting});
  return arguments;
}

TEST(OneAzimuth, AnIsotropicTableIsRefinedAndJudgedAtEveryAzimuth) {
  const TemporaryDirectory folder;
  const ProgramResult made = run_ltcfit(
      generate({"table.lambda.first=1", "table.lambda.nodes=1", "refine.steps=4"}), folder.path());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("refined  4 steps over "), std::string::npos) << made.out;
  EXPECT_NE(made.out.find("lambda 1 to 1"), std::string::npos) << made.out;
  EXPECT_EQ(made.out.find("warning"), std::string::npos) << made.out;

  const ProgramResult judged = run_ltcfit(validate({"quality.query_loss=0.2"}), folder.path());
  EXPECT_EQ(judged.exit_code, 0) << judged.err << judged.out;
  EXPECT_EQ(judged.out.find(" nan"), std::string::npos) << judged.out;
  EXPECT_EQ(judged.out.find("-nan"), std::string::npos) << judged.out;
  EXPECT_EQ(judged.out.find("beyond"), std::string::npos) << judged.out;
  const auto json = nlohmann::json::parse(read_file(folder / "t.json"));
  EXPECT_EQ(json["quality"]["query_loss"]["count"], 40);
  EXPECT_EQ(json["quality"]["query_range"]["phi_degrees"], (nlohmann::json{0.0, 90.0}));
}

TEST(OneAzimuth, OtherTablesServeTheirAzimuthAloneAndSaySo) {
  const TemporaryDirectory folder;
  const ProgramResult made =
      run_ltcfit(generate({"table.lambda.nodes=3", "table.phi.first_degrees=30", "refine.steps=0"}),
                 folder.path());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("warning  one node along phi"), std::string::npos) << made.out;
  EXPECT_NE(made.out.find("phi = 30 alone"), std::string::npos) << made.out;
}

TEST(OneAzimuth, WhatIsNotJudgedIsNeitherPassedNorANumber) {
  const TemporaryDirectory folder;
  ASSERT_EQ(run_ltcfit(generate({"table.lambda.nodes=1", "table.lambda.first=1", "refine.steps=0"}),
                       folder.path())
                .exit_code,
            0);
  const ProgramResult unjudged = run_ltcfit(validate({"quality.queries=0"}), folder.path());
  EXPECT_EQ(unjudged.exit_code, 0) << unjudged.err << unjudged.out;
  EXPECT_EQ(unjudged.out.find(" nan"), std::string::npos) << unjudged.out;
  EXPECT_EQ(unjudged.out.find("-nan"), std::string::npos) << unjudged.out;
  EXPECT_NE(unjudged.out.find("not judged"), std::string::npos) << unjudged.out;
  const auto json = nlohmann::json::parse(read_file(folder / "t.json"));
  EXPECT_TRUE(json["quality"]["thresholds"][1]["value"].is_null());
  EXPECT_TRUE(json["quality"]["thresholds"][1]["passed"].is_null());

  const ProgramResult demanded =
      run_ltcfit(validate({"quality.queries=0", "quality.query_loss=0.2"}), folder.path());
  EXPECT_EQ(demanded.exit_code, 1) << demanded.out;
  EXPECT_NE(demanded.err.find("is not judged"), std::string::npos) << demanded.err;
  EXPECT_NE(demanded.out.find("not judged quality.query_loss"), std::string::npos) << demanded.out;
}

}  // namespace
}  // namespace ltc::test
