// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A run as a library call, without the program: scene, extending, files, warnings.
#include "pipeline/run.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/write_file.h"
#include "export/same_tables.h"
#include "export/table_file.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

RunRequest small_request() {
  const std::vector<std::string> small{"table.alpha.nodes=3",         "table.lambda.nodes=2",
                                       "table.theta.nodes=3",         "table.phi.nodes=2",
                                       "fit.gauss_newton.samples=64", "refine.steps=0"};
  RunRequest request;
  request.config = load_config(std::nullopt, small);
  request.created = "2026-01-01T00:00:00Z";
  return request;
}

// Smooth materials: the last node of alpha is none of theirs.
const std::string smooth_scene = R"([[material]]
name = "smooth"
alpha_x = [0.0, 0.2]
alpha_y = [0.0, 0.2]
)";

TEST(Run, WithoutAFolderIsThePipelineAlone) {
  const RunRequest request = small_request();
  const RunReport report = make_table(request, {2});
  Table expected = generate_table(request.config, {1});
  expected.created = request.created;
  testing::expect_same_tables(report.table, expected);
  EXPECT_EQ(report.needed, 36u);
  EXPECT_EQ(report.added, 36u);
  EXPECT_FALSE(report.extends);
  EXPECT_TRUE(report.files.empty());
}

TEST(Run, AScenesPartIsExtendedToTheWholeTable) {
  const test::TemporaryDirectory folder;
  write_file(folder / "smooth.toml", smooth_scene);
  RunRequest request = small_request();
  request.scene = folder / "smooth.toml";
  request.folder = folder / "part";  // which is made
  const RunReport part = make_table(request, {2});
  EXPECT_GT(part.needed, 0u);
  EXPECT_LT(part.needed, 36u);
  EXPECT_EQ(part.files.front(), folder / "part/ltc.h5");
  EXPECT_FALSE(std::filesystem::exists(folder / "part/ltc.checkpoint.h5"));

  RunRequest rest = small_request();
  rest.extend = folder / "part/ltc.h5";
  const RunReport whole = make_table(rest, {2});
  EXPECT_TRUE(whole.extends);
  EXPECT_EQ(whole.added, 36u - part.needed);
  const Table expected = make_table(small_request(), {2}).table;
  testing::expect_same_bits(whole.table.stored, expected.stored, "stored");

  rest.extend = folder / "part/ltc.npy";
  test::expect_one_line(test::message_of<InputError>([&] { make_table(rest, {1}); }),
                        {"ltc.npy", "cannot be extended", ".h5"});
}

TEST(Run, WarningsOfTheSceneAreHeardAndNoneIsNoFailure) {
  const test::TemporaryDirectory folder;
  write_file(folder / "s.gltf",
             R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_unheard_of"],
                 "materials": [{"pbrMetallicRoughness": {"roughnessFactor": 0.3},
                                "extensions": {"EXT_unheard_of": {"roughnessFactor": 0.9}}}]})");
  RunRequest request = small_request();
  request.scene = folder / "s.gltf";
  const Table unheard = make_table(request, {1}).table;
  std::vector<std::string> heard;
  request.warn = [&](const std::string& line) { heard.push_back(line); };
  testing::expect_same_bits(make_table(request, {1}).table.stored, unheard.stored, "stored");
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_NE(heard[0].find("EXT_unheard_of"), std::string::npos) << heard[0];
}

TEST(Run, RemovesWhatItDoesNotWriteButNoInput) {
  const test::TemporaryDirectory folder;
  write_file(folder / "ltc.npy", "of an older table");
  RunRequest request = small_request();
  request.folder = folder.path();
  request.config.output.npy = false;
  request.inputs = {folder / "ltc.npy"};
  test::expect_one_line(test::message_of<InputError>([&] { make_table(request, {1}); }),
                        {"ltc.npy", "would be removed", "output.name"});
  EXPECT_TRUE(std::filesystem::exists(folder / "ltc.npy"));
  request.inputs.clear();
  const RunReport report = make_table(request, {1});
  EXPECT_EQ(report.removed, std::vector<std::filesystem::path>{folder / "ltc.npy"});
  EXPECT_FALSE(std::filesystem::exists(folder / "ltc.npy"));
  EXPECT_TRUE(report.left_out.empty());
}

TEST(Run, SaysWhichFormatsCannotHoldTheTable) {
  const test::TemporaryDirectory folder;
  RunRequest request = small_request();
  request.folder = folder.path();
  request.config.grid.alpha_min = 1e-3;
  const RunReport report = make_table(request, {1});
  ASSERT_EQ(report.left_out.size(), 1u);
  EXPECT_EQ(report.left_out[0].first, "NPY");
  EXPECT_EQ(report.files.size(), 4u);
}

TEST(Run, ResumesByTheCallersName) {
  const test::TemporaryDirectory folder;
  RunRequest request = small_request();
  request.folder = folder.path();
  request.resume_name = "Again";
  write_file(folder / "ltc.checkpoint.h5", "of another run");
  test::expect_one_line(test::message_of<InputError>([&] { make_table(request, {1}); }),
                        {"ltc.checkpoint.h5", "go on with Again"});
  std::filesystem::remove(folder / "ltc.checkpoint.h5");
  request.resume = true;
  std::vector<std::string> heard;
  request.warn = [&](const std::string& line) { heard.push_back(line); };
  EXPECT_EQ(make_table(request, {1}).resumed, 0u);
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_NE(heard[0].find("no checkpoint"), std::string::npos);
}

}  // namespace
}  // namespace ltc
