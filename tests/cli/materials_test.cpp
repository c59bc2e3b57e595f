// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Beckmann, sheen and a file of values through the real program: tables, files that name their BRDF
// and files that do not, judges, pictures, and what is refused.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "brdf/albedo.h"
#include "brdf/beckmann.h"
#include "brdf/charlie.h"
#include "core/hdf5_file.h"
#include "export/table_file.h"
#include "judge/area_light.h"
#include "stress/lobes.h"
#include "support/refused_run.h"
#include "table/lookup.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

ProgramResult expect_done(const Arguments& arguments, const fs::path& folder) {
  const ProgramResult result = run_ltcfit(arguments, folder);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result;
}

Arguments sheen_of(const std::string& nodes) {
  return {"generate",
          "--config",
          LTCFIT_SOURCE_DIR "/config/sheen.toml",
          "--set",
          "table.alpha.nodes=" + nodes,
          "--set",
          "table.theta.nodes=" + nodes,
          "-o",
          "t"};
}

// The table alone, in HDF5, on a few nodes of every axis.
const Arguments small = {"generate",
                         "--set",
                         "table.alpha.nodes=3",
                         "--set",
                         "table.lambda.nodes=3",
                         "--set",
                         "table.theta.nodes=4",
                         "--set",
                         "table.phi.nodes=3",
                         "--set",
                         "refine.held_out_queries=200",
                         "-o",
                         "t"};

Arguments with(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(MaterialsRun, SheenIsNearItselfUnderAreaLights) {
  const TemporaryDirectory folder;
  expect_done(sheen_of("22"), folder.path());
  const Table table = read_table(folder / "t/ltc.h5");
  EXPECT_EQ(table.grid.model, &charlie());
  AreaLightJudge judge({.quads = 64, .samples = 16384});
  double largest = 0;
  for (const double roughness : {0.1, 0.15, 0.3, 0.6, 1.0}) {
    double sum = 0;
    std::uint64_t draw = 0;
    for (const double cosine : {0.99, 0.8, 0.55, 0.3, 0.1, 0.02}) {
      const Lobe lobe{roughness * roughness, roughness * roughness, std::acos(cosine), 0,
                      &charlie()};
      judge.set_lobe(lobe, draw++);
      sum += judge.error({look_up(table, lobe).ltc()}).mean_absolute;
    }
    largest = std::max(largest, sum / 6);
  }
  // The whole table on 64 x 64 nodes has at most 0.0103 in any row from 0.1 on, this one more at its
  // coarse first rows; a clamped cosine has 0.15 and more.
  EXPECT_LT(largest, 0.02);
  EXPECT_GT(largest, 0.002);
  // Amplitudes are the albedo's.
  for (const std::size_t entry : {std::size_t{100}, std::size_t{250}, std::size_t{480}})
    EXPECT_NEAR(table.amplitude[entry],
                integrate_albedo(table.grid.lobe(entry), AlbedoRule(65536)).amplitude, 1e-4);
}

TEST(MaterialsRun, TexturesOfSheenAreReadBackWithItsName) {
  const TemporaryDirectory folder;
  expect_done(with(sheen_of("6"), {"--set", "refine.steps=0"}), folder.path());
  const Table table = read_table(folder / "t/ltc.h5");
  ReadAs as;
  as.model = &charlie();
  const Table texture = read_table(folder / "t/ltc_1.dds", as);
  EXPECT_EQ(texture.grid.model, &charlie());
  for (std::size_t entry = 0; entry < table.grid.size(); ++entry) {
    EXPECT_NEAR(texture.amplitude[entry], table.amplitude[entry], 1e-6f);
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_NEAR(texture.stored[9 * entry + i], table.stored[9 * entry + i], 1e-5f);
  }
  // Judged as what it is, and, without the name, taken for GGX or for nothing.
  const Arguments validate = {
      "validate", "t/ltc_1.dds",       "--no-invariants", "--set", "quality.nodes=36",
      "--set",    "quality.queries=0", "--json",          "-"};
  const auto as_sheen =
      nlohmann::json::parse(run_ltcfit(with(validate, {"--brdf", "charlie"}), folder.path()).out);
  EXPECT_LT(as_sheen["quality"]["node_loss"]["mean"].get<double>(), 0.3);
  expect_error(run_ltcfit(validate, folder.path()), 2, {"ltc_1.dds", "no layout"});
}

TEST(MaterialsRun, OpenExrNamesItsBrdf) {
  const TemporaryDirectory folder;
  expect_done(with(small, {"--set", "table.brdf=beckmann"}), folder.path());
  EXPECT_EQ(read_table(folder / "t/ltc.h5").grid.model, &beckmann());
  EXPECT_EQ(read_table(folder / "t/ltc.0.exr").grid.model, &beckmann());
  expect_done(small, folder.path());
  EXPECT_EQ(read_table(folder / "t/ltc.0.exr").grid.model, &ggx());
}

TEST(MaterialsRun, BeckmannIsFittedFoldedAndAsAField) {
  const TemporaryDirectory folder;
  const std::string field = LTCFIT_SOURCE_DIR "/config/field.toml";
  expect_done(
      {"generate", "--config", field, "--set", "table.brdf=beckmann", "--set", "field.size=120",
       "--set", "field.queries=1000", "--set", "refine.held_out_queries=100", "-o", "f"},
      folder.path());
  EXPECT_EQ(read_table(folder / "f/ltc_field.json").grid.model, &beckmann());
  const ProgramResult folded =
      expect_done({"fit", "--set", "table.brdf=beckmann", "--set", "fit.lobe=folded", "--alpha-x",
                   "0.5", "--alpha-y", "0.1", "--theta", "50", "--phi", "30", "--plot", "p.png"},
                  folder.path());
  EXPECT_TRUE(fs::exists(folder / "p.png"));
}

TEST(MaterialsRun, WhatABrdfHasNotIsRefusedBeforeTheWork) {
  const TemporaryDirectory folder;
  const auto refusal = [&](const Arguments& arguments, const std::vector<std::string>& parts) {
    expect_error(run_ltcfit(arguments, folder.path()), 2, parts);
    EXPECT_FALSE(fs::exists(folder / "t/ltc.h5"));
  };
  refusal(with(small, {"--set", "table.brdf=charlie", "--set", "table.alpha_min=0.01"}),
          {"table.brdf", "charlie", "isotropic"});
  refusal(with(sheen_of("4"), {"--set", "table.alpha_min=1e-4"}), {"charlie", "0.0001", "0.001"});
  refusal(with(sheen_of("4"), {"--set", "table.storage=mirror-frame", "--set", "output.dds=false"}),
          {"charlie", "mirror-frame", "inverse"});
  refusal(with(sheen_of("4"), {"--set", "fit.lobe=folded", "--set", "table.storage=folded", "--set",
                               "output.dds=false"}),
          {"charlie", "folded"});
  refusal(with(small, {"--set", "table.brdf=phong"}), {"table.brdf", "phong", "beckmann", ".h5"});
  expect_error(run_ltcfit(with(small, {"--set", "table.brdf=none.h5"}), folder.path()), 3,
               {"none.h5"});
  refusal({"fit", "--set", "table.brdf=charlie", "--alpha-x", "0.5", "--alpha-y", "0.1", "--theta",
           "50", "--phi", "30"},
          {"charlie", "isotropic"});
  expect_done(with(sheen_of("4"), {"--set", "refine.steps=0"}), folder.path());
  expect_error(run_ltcfit({"render", "t/ltc.h5", "--material", "0.5,0.1"}, folder.path()), 2,
               {"charlie", "isotropic"});
  // The materials that are usual are those that it has.
  expect_done({"render", "t/ltc.h5", "--size", "16", "--samples", "16"}, folder.path());
}

TEST(MaterialsRun, StressLobesAreThoseThatAModelHas) {
  const std::vector<StressLobe> grid = grid_lobes(stress_axes(StressDensity::full));
  const std::vector<StressLobe> sheen = lobes_of_model(grid, charlie());
  EXPECT_EQ(sheen.size(), 4u * 1 * 5 * 5);  // alpha from 1e-3, lambda = 1
  for (const StressLobe& lobe : sheen)
    EXPECT_EQ(lobe.lobe().model, &charlie());
  EXPECT_EQ(lobes_of_model(grid, beckmann()).size(), grid.size());
  // Random ones have another ratio than 1 each, and keep their larger roughness.
  EXPECT_GT(lobes_of_model(random_lobes(200, 1), charlie()).size(), 50u);
}

TEST(MaterialsRun, AStressRunOfSheenPasses) {
  const TemporaryDirectory folder;
  expect_done({"stress", "--quick", "--solver", "gauss-newton", "--set", "table.brdf=charlie"},
              folder.path());
}

}  // namespace
}  // namespace ltc::test
