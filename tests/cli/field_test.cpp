// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Fields through the real program: made, judged, looked up, rendered, converted, baked.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/refused_run.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

using Arguments = std::vector<std::string>;

const Arguments make_field = {"generate",
                              "--config",
                              LTCFIT_SOURCE_DIR "/config/field.toml",
                              "-o",
                              "t",
                              "--set",
                              "field.size=64",
                              "--set",
                              "field.albedo_size=40",
                              "--set",
                              "field.queries=1000",
                              "--set",
                              "field.steps=1",
                              "--set",
                              "refine.held_out_queries=100"};

TEST(FieldCommands, AFieldGoesWhereTablesGo) {
  const TemporaryDirectory folder;
  const ProgramResult made = run_ltcfit(make_field, folder.path());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("field    64 numbers for the matrix"), std::string::npos) << made.out;
  EXPECT_EQ(names_in(folder / "t"),
            (std::vector<std::string>{"ltc.glsl", "ltc.h", "ltc.h5", "ltc.hlsl", "ltc.mjs",
                                      "ltc.wgsl", "ltc_field.json"}));
  folder.write("q.csv", "alpha_x,alpha_y,theta,phi\n0.3,0.1,0.5,0.2\n");
  const ProgramResult json =
      run_ltcfit({"lookup", "t/ltc_field.json", "-q", "q.csv"}, folder.path());
  EXPECT_EQ(json.exit_code, 0) << json.err;
  EXPECT_EQ(json.out, run_ltcfit({"lookup", "t/ltc.h5", "-q", "q.csv"}, folder.path()).out);

  for (const Arguments& arguments : std::vector<Arguments>{
           {"fit", "--as-in", "t/ltc_field.json", "--alpha-x", "0.4", "--alpha-y", "0.1", "--theta",
            "60", "--phi", "30"},
           {"render", "t/ltc_field.json", "--size", "16", "--samples", "16", "-o", "r"},
           {"convert", "t/ltc_field.json", "-o", "t.npy"},
           {"bake", "t/ltc_field.json", "-o", "b.h5", "--set", "table.alpha.nodes=3"},
           {"bake", "t/ltc.h5", "-o", "b.ktx2", "--half"},
           {"diff", "t/ltc_field.json", "b.h5", "--queries", "20"}}) {
    const ProgramResult result = run_ltcfit(arguments, folder.path());
    EXPECT_EQ(result.exit_code, 0) << arguments[0] << ": " << result.err;
  }
  // The same again by the config that it has.
  const ProgramResult again =
      run_ltcfit({"generate", "--config", "t/ltc_field.json", "-o", "t2"}, folder.path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(read_file(folder / "t2/ltc.mjs"), read_file(folder / "t/ltc.mjs"));

  const ProgramResult baked = run_ltcfit({"lookup", "b.h5", "-q", "q.csv"}, folder.path());
  EXPECT_EQ(baked.exit_code, 0) << baked.err;
  EXPECT_NE(baked.out, json.out);  // interpolated
}

TEST(FieldCommands, ValidateKnowsAField) {
  const TemporaryDirectory folder;
  ASSERT_EQ(run_ltcfit(make_field, folder.path()).exit_code, 0);
  const ProgramResult judged =
      run_ltcfit({"validate", "t/ltc_field.json", "--no-quality", "--set",
                  "invariants.albedo_error=0.3", "--set", "invariants.neighbour_excess=1e9"},
                 folder.path());
  EXPECT_NE(judged.out.find("a field's matrices are not stored"), std::string::npos) << judged.out;
  EXPECT_NE(judged.out.find("determinant"), std::string::npos);
  EXPECT_EQ(judged.exit_code, 0) << judged.err;
}

TEST(FieldCommands, ContractsToOneMaterial) {
  const TemporaryDirectory folder;
  ASSERT_EQ(run_ltcfit(make_field, folder.path()).exit_code, 0);
  for (const std::string file : {"m_field.json", "m.glsl", "m.h"}) {
    const ProgramResult made = run_ltcfit(
        {"bake", "t/ltc_field.json", "--material", "0.1,0.4", "-o", file}, folder.path());
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_TRUE(made.err.starts_with("bake: ")) << made.err;
  }
  // Both orders of its roughnesses, and no others.
  folder.write("q.csv",
               "alpha_x,alpha_y,theta,phi\n0.4,0.1,0.5,0.2\n0.1,0.4,0.5,0.2\n0.4,0.2,0.5,0.2\n");
  const ProgramResult found = run_ltcfit({"lookup", "m_field.json", "-q", "q.csv"}, folder.path());
  EXPECT_EQ(found.exit_code, 0) << found.err;
  const std::string text = found.out;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4) << text;
  EXPECT_GT(text.find("nan"), text.find("0.4,0.2,")) << text;
  EXPECT_NE(text.find("nan"), std::string::npos) << text;
  const auto json = nlohmann::json::parse(read_file(folder / "m_field.json"));
  std::size_t numbers = 0;
  for (const auto& part : json["parts"])
    numbers += part["coefficients"].size();
  EXPECT_LE(numbers, 60u);
  expect_error(run_ltcfit({"bake", "m_field.json", "-o", "x.h5"}, folder.path()), 2,
               {"m_field.json", "a field of one material"});
  expect_error(run_ltcfit({"bake", "t/ltc_field.json", "--material", "0.1,0.4", "-o", "x.h5"},
                          folder.path()),
               2, {"x.h5", "no suffix of a field"});
}

TEST(FieldCommands, AFoldedFieldGoesWhereItsFormatsKnowIt) {
  const TemporaryDirectory folder;
  Arguments folded = make_field;
  folded[2] = LTCFIT_SOURCE_DIR "/config/folded-field.toml";
  const ProgramResult made = run_ltcfit(folded, folder.path());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  // All that knows a fold.
  EXPECT_EQ(names_in(folder / "t"),
            (std::vector<std::string>{"ltc.0.exr", "ltc.1.exr", "ltc.2.exr", "ltc.3.exr",
                                      "ltc.glsl", "ltc.h", "ltc.h5", "ltc.hlsl", "ltc.mjs",
                                      "ltc.wgsl", "ltc_field.json"}));
  const ProgramResult judged =
      run_ltcfit({"validate", "t/ltc_field.json", "--set", "quality.queries=20"}, folder.path());
  // So small a field need not pass.
  EXPECT_LE(judged.exit_code, 1) << judged.err;
  EXPECT_NE(judged.out.find("fold one to one"), std::string::npos) << judged.out;
  for (const char* light : {"rectangle", "star", "disk", "sphere", "line"})
    EXPECT_EQ(run_ltcfit({"render", "t/ltc_field.json", "--size", "16", "--samples", "16",
                          "--light", light, "-o", "r"},
                         folder.path())
                  .exit_code,
              0)
        << light;
  const ProgramResult entry = run_ltcfit(
      {"fit", "--as-in", "t/ltc_field.json", "--entry", "1,1,1,1"}, folder.path());
  EXPECT_NE(entry.out.find("\nfold     k "), std::string::npos) << entry.out << entry.err;
  expect_error(run_ltcfit({"fit", "--start", "from=t/ltc_field.json", "--entry", "1,1,1,1"},
                          folder.path()),
               2, {"t/ltc_field.json", "its lobes are folded"});
  expect_error(run_ltcfit({"convert", "t/ltc_field.json", "-o", "t.npy"}, folder.path()), 2,
               {"t.npy", "cannot hold folded lobes"});
  EXPECT_EQ(run_ltcfit({"view", "t/ltc_field.json"}, folder.path()).exit_code, 0);
  // Functions have one pair of creases.
  folded.insert(folded.end(), {"--set", "fit.second_crease=1.2"});
  expect_error(run_ltcfit(folded, folder.path()), 2,
               {"which [output] asks for", "fit.second_crease = 1.2"});
  nlohmann::json pairs = nlohmann::json::parse(read_file(folder / "t/ltc_field.json"));
  pairs["creases"] = {0.4, 1.2};
  folder.write("pairs_field.json", pairs.dump());
  expect_error(run_ltcfit({"convert", "pairs_field.json", "-o", "p.glsl"}, folder.path()), 2,
               {"p.glsl", "one pair of creases", "0.4, 1.2"});
  expect_error(run_ltcfit({"view", "pairs_field.json"}, folder.path()), 2,
               {"pairs_field.json", "2 pairs of creases"});
  expect_error(run_ltcfit({"generate", "-o", "u", "--set", "table.storage=folded"}, folder.path()), 2,
               {"table.storage = \"folded\"", "fit.lobe = \"single\""});
}

TEST(FieldCommands, WhatIsNoFieldIsRefused) {
  const TemporaryDirectory folder;
  ASSERT_EQ(run_ltcfit(make_field, folder.path()).exit_code, 0);
  folder.write("bad_field.json", "{\"format\": \"ltc-field\", \"format_version\": 3}");
  expect_error(run_ltcfit({"validate", "bad_field.json"}, folder.path()), 2,
               {"bad_field.json", "format_version is 3", "allowed: 1"});
  expect_error(run_ltcfit({"bake", "t/ltc_field.json", "-o", "t.mjs"}, folder.path()), 2,
               {"t.mjs", "no suffix of a table"});
  ASSERT_EQ(run_ltcfit({"bake", "t/ltc_field.json", "-o", "b.h5"}, folder.path()).exit_code, 0);
  expect_error(run_ltcfit({"bake", "b.h5", "-o", "c.h5"}, folder.path()), 2,
               {"b.h5", "a table of nodes"});
  expect_error(run_ltcfit({"generate", "-o", "u", "--set", "field.loss=0.1"}, folder.path()), 2,
               {"field.loss = 0.1", "field.size is 0"});
  expect_error(run_ltcfit({"generate", "-o", "u", "--set", "field.size=64", "--extend", "b.h5"},
                          folder.path()),
               2, {"b.h5", "nothing extends it"});
  expect_error(run_ltcfit({"lookup", "t/ltc.glsl", "-q", "x"}, folder.path()), 2, {"t/ltc.glsl"});
  expect_error(run_ltcfit({"generate", "-o", "u", "--set", "output.header=true", "--set",
                           "output.c_header=true"},
                          folder.path()),
               2, {"u/ltc.h", "same file"});
}

}  // namespace
}  // namespace ltc::test
