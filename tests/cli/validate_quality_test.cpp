// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The quality that ltcfit validate measures and the page that it writes, through the real program.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/refused_run.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Few samples: what is tested is the way of the figures, not their last digits.
std::vector<std::string> quick(std::vector<std::string> arguments) {
  for (const char* key : {"node_samples=256", "node_directions=4", "queries=20",
                          "query_samples=256", "query_directions=4", "quad_samples=256"}) {
    arguments.push_back("--set");
    arguments.push_back(std::string("quality.") + key);
  }
  return arguments;
}

// Beyond what a table of so few nodes has.
std::vector<std::string> lenient(std::vector<std::string> arguments) {
  for (const char* key : {"node_loss=1", "query_loss=1", "area_light_error=1"}) {
    arguments.push_back("--set");
    arguments.push_back(std::string("quality.") + key);
  }
  return arguments;
}

class ValidateQuality : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryDirectory;
    const ProgramResult made = run_ltcfit(
        {"generate", "--output", folder_->path().string(), "--set", "table.alpha.nodes=3", "--set",
         "table.lambda.nodes=3", "--set", "table.theta.nodes=3", "--set", "table.phi.nodes=3",
         "--set", "refine.steps=0"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static std::string table() { return (*folder_ / "ltc.h5").string(); }

 private:
  static inline TemporaryDirectory* folder_ = nullptr;
};

// The page is one well-formed file.
void expect_whole_page(const std::string& out, const fs::path& folder) {
  EXPECT_NE(out.find("wrote new/page/index.html\n"), std::string::npos) << out;
  const std::string page = read_file(folder / "new/page/index.html");
  for (const char* words : {"✓ Sound", "data:image/png;base64,", "Loss between nodes by theta",
                            "Condition number of M", "Spheres under a rectangular light", "query"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
  // Nothing comes from elsewhere.
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("href="), std::string::npos);
  const ProgramResult parsed = run_program(
      {"/usr/bin/python3", "-c", "import sys, xml.dom.minidom as x; x.parse(sys.argv[1])",
       (folder / "new/page/index.html").string()});
  EXPECT_EQ(parsed.exit_code, 0) << parsed.err;
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& file : fs::directory_iterator(folder / "new/page"))
    ++files;
  EXPECT_EQ(files, 1u);
}

TEST_F(ValidateQuality, IsPrintedAndWrittenAsJsonAndAsAPage) {
  const TemporaryDirectory folder;
  const ProgramResult result =
      run_ltcfit(quick(lenient({"validate", table(), "--json", "r.json", "--report", "new/page"})),
                 folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const std::string& words : std::vector<std::string>{
           "loss / spread between nodes", "by perceptual roughness", "by theta",
           "queries furthest above the floor", "ltcfit fit --as-in " + table() + " --alpha-x"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words << "\n" << result.out;
  const Json quality = Json::parse(read_file(folder / "r.json"))["quality"];
  EXPECT_EQ(quality["queries"].size(), 20u);
  EXPECT_EQ(quality["node_losses"].size(), 81u);
  double sum = 0;
  for (const Json& query : quality["queries"])
    sum += query["loss"].get<double>();
  EXPECT_NEAR(quality["query_loss"]["mean"].get<double>(), sum / 20, 1e-12);
  EXPECT_LT(quality["floor_loss"]["mean"], quality["query_loss"]["mean"]);
  ASSERT_EQ(quality["thresholds"].size(), 3u);
  for (const Json& threshold : quality["thresholds"])
    EXPECT_EQ(threshold["passed"], true);
  expect_whole_page(result.out, folder.path());
}

TEST_F(ValidateQuality, AThresholdThatIsPassedIsNamed) {
  const ProgramResult result =
      run_ltcfit(quick({"validate", table(), "--set", "quality.node_loss=1", "--set",
                        "quality.area_light_error=1", "--set", "quality.query_loss=0.01"}));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("mean relative loss between nodes is "), std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("above quality.query_loss = 0.01\n"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("FAILED quality.query_loss"), std::string::npos) << result.out;
}

TEST_F(ValidateQuality, RefusesBadInputInOneLine) {
  expect_refused({"validate", table(), "--report", "/proc/none"}, 3, {"/proc/none"});
  expect_refused({"validate", table(), "--set", "quality.query_directions=0"}, 2,
                 {"quality.query_directions", "[4, 4096]"});
  expect_refused({"validate", table(), "--set", "quality.horizon=cut"}, 2,
                 {"quality.horizon", "cut", "clipped", "scaled"});
  for (const char* option : {"--no-quality", "--no-invariants"})
    expect_refused({"validate", table(), option, "--report", "x"}, 2, {option});
}

}  // namespace
}  // namespace ltc::test
