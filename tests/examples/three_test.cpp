// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// examples/three: three.js in Chromium renders with the table in place of its own, and nearer to
// GGX; and anisotropic materials by a table and by a field, in WebGL and WebGPU, as `ltcfit render`
// does.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "support/program.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

const fs::path example = LTCFIT_SOURCE_DIR "/examples/three";
const fs::path its_own =
    example / "node_modules/three/examples/jsm/lights/RectAreaLightTexturesLib.js";

bool found(const std::string& program) {
  return run_program({"sh", "-c", "command -v " + program}).exit_code == 0;
}

class Three : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(its_own) || !found("node") || !found("chromium"))
      GTEST_SKIP() << "no node, no chromium, or no three.js: npm ci --prefix examples/three";
  }

  ProgramResult run(const fs::path& table, const Arguments& more) {
    Arguments command = {"node", example / "run.js", table, "--json", "figures.json"};
    command.insert(command.end(), more.begin(), more.end());
    return run_program(command, folder.path());
  }

  ProgramResult generate(Arguments more) {
    more.insert(more.begin(), {"generate", "--config", LTCFIT_SOURCE_DIR "/config/three.toml", "-o",
                               "t", "--set", "refine.steps=0"});
    return run_ltcfit(more, folder.path());
  }

  nlohmann::json spheres() const {
    return nlohmann::json::parse(read_file(folder / "figures.json"))["spheres"];
  }

  const TemporaryDirectory folder;
  const fs::path made = folder / "t/RectAreaLightTexturesLib.js";
};

// Measured at this size, ours (unrefined) over its own: 1.03, 0.95, 0.60, 0.51 as rendered, where
// three's formula for polygons is most of the error of smooth ones; the lobes alone 1.28, 0.92,
// 0.52, 0.46. Browsers differ by rounding alone: a tenth is left for that.
TEST_F(Three, RendersNearerToGgxWithTheTable) {
  ASSERT_EQ(generate({}).exit_code, 0);
  const ProgramResult result =
      run(made, {"--size", "100", "--light-size", "0.3", "-o", "picture.png"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json figures = spheres();
  ASSERT_EQ(figures.size(), 4u);
  const double as_rendered[] = {1.13, 1.05, 0.67, 0.57}, of_lobes[] = {1.4, 1.02, 0.58, 0.51};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto value = [&](const char* name) { return figures[i][name].get<double>(); };
    EXPECT_LT(value("given"), as_rendered[i] * value("own")) << figures[i];
    EXPECT_LT(value("given_lobes"), of_lobes[i] * value("own_lobes")) << figures[i];
    EXPECT_LT(value("reference_error"), 0.2 * value("given_lobes")) << figures[i];
    EXPECT_GT(value("own"), 0.04) << "three's own table was changed: " << figures[i];
    EXPECT_LT(value("own"), 0.15) << figures[i];
  }
  EXPECT_EQ(read_file(folder / "picture.png").substr(1, 3), "PNG");
}

TEST_F(Three, RendersAlikeWithItsOwnTableInItsPlace) {
  const ProgramResult result = run(its_own, {"--size", "16", "--roughness", "0.5"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json figures = spheres().at(0);
  EXPECT_EQ(figures["given"], figures["own"]);
  EXPECT_EQ(figures["given_lobes"], figures["own_lobes"]);
}

TEST_F(Three, WhatItCannotRenderIsRefused) {
  ASSERT_EQ(generate({"--set", "table.alpha.nodes=8", "--set", "table.theta.nodes=8"}).exit_code,
            0);
  const fs::path no_module = folder.write("no_module.js", "{\"a\": 1}");
  const fs::path missing = folder / "missing.js";
  for (const auto& [table, option, code, part] :
       {std::tuple(made, "--size=16", 1, "the table is 8 x 8; three's shader takes 64 x 64"),
        std::tuple(no_module, "--size=16", 1, "no_module.js: Unexpected token"),
        std::tuple(missing, "--size=16", 3, "missing.js"),
        std::tuple(made, "--size=0", 2, "--size is 0; allowed: 16 to 1000"),
        std::tuple(made, "--roughness=0.5,", 2, "--roughness is 0.5,; allowed: 0.1 to 1"),
        std::tuple(made, "--tables", 2, "--tables")}) {
    const ProgramResult result = run(table, {option});
    EXPECT_EQ(result.exit_code, code) << result.out;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(folder / "figures.json"));
  }
}

class ThreeAnisotropic : public Three {
 protected:
  // Made quickly: how good they are is not the question.
  void make_table_and_field() {
    const std::string configs = LTCFIT_SOURCE_DIR "/config/";
    for (const Arguments& how :
         {Arguments{"default.toml", "-o", "table", "--set", "refine.steps=0"},
          Arguments{"field.toml", "-o", "field", "--set", "field.size=128"}}) {
      Arguments command{"generate", "--config", configs + how[0]};
      command.insert(command.end(), how.begin() + 1, how.end());
      ASSERT_EQ(run_ltcfit(command, folder.path()).exit_code, 0);
    }
  }

  ProgramResult run(const std::string& table, const std::string& field, const std::string& ltcfit,
                    const Arguments& more) {
    Arguments command{
        "node",        example / "anisotropic-run.js", table, field, "--ltcfit", ltcfit, "--json",
        "figures.json"};
    command.insert(command.end(), more.begin(), more.end());
    return run_program(command, folder.path());
  }
};

// The same formulas in 32 bits, where 64 are the reference's: measured 2e-5 at alpha 0.04.
constexpr double by_rays = 1e-4;

// Rasterizers put vertices on a grid, SwiftShader's of 1/16 of a pixel. Half a step is 1.7e-4 of
// the sphere's radius, 180 pixels of the two a side that make one here; over an alpha a highlight
// changes by up to 1. Measured: a third to a half of that, 5e-4 at 0.09 and 2e-3 at 0.04.
double by_mesh(const nlohmann::json& sphere) {
  return 1.7e-4 / std::min(sphere["alpha_x"].get<double>(), sphere["alpha_y"].get<double>());
}

TEST_F(ThreeAnisotropic, RendersAsLtcfitDoesInWebGlAndWebGpu) {
  ASSERT_NO_FATAL_FAILURE(make_table_and_field());
  const ProgramResult done =
      run("table/ltc.h5", "field/ltc_field.json", LTCFIT_PROGRAM,
          {"--size", "192", "--samples", "256", "-o", "picture.png", "--variants", "--material",
           "0.3,0.7", "--material", "0.3,0.7,90", "--material", "0.5,0.5", "--material", "0.2,0.4",
           "--material", "0.4,0"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(read_file(folder / "picture.png").substr(1, 3), "PNG");
  const nlohmann::json result = nlohmann::json::parse(read_file(folder / "figures.json"));
  ASSERT_EQ(result["spheres"].size(), 5u);
  // Without anisotropy three.js has no tangents. Of a field the lobes are isotropic then, exactly;
  // those of a table depend on the frame, between its nodes of phi: 0.012 here.
  const auto turns = [](const nlohmann::json& sphere, std::string_view by) {
    return sphere["anisotropy"] == 0 && by == "table" ? 0.05 : 0.0;
  };
  for (const nlohmann::json& sphere : result["spheres"])
    for (const char* by : {"table", "field"}) {
      EXPECT_GT(sphere["reference_mean"], 0.03) << sphere;
      EXPECT_LT(sphere["rays_from_ltcfit"][by], by_rays + turns(sphere, by)) << sphere;
      EXPECT_LT(sphere["webgl_from_ltcfit"][by], by_mesh(sphere) + turns(sphere, by)) << sphere;
      EXPECT_NEAR(sphere["error"][by], sphere["error_of_ltcfit"][by].get<double>(), 2e-3);
      // Measured 7 to 14 % of what three.js is off that knows no anisotropy here.
      if (sphere["anisotropy"] > 0) {
        EXPECT_LT(sphere["error"][by], 0.2 * sphere["error"]["three"].get<double>()) << sphere;
      }
    }
  const auto changes = [&](const char* variant) {
    return result["variants"][variant]["from_ltcfit"];
  };
  // What the comparison is there to find.
  EXPECT_GT(changes("roughness for alpha"), 0.1);
  EXPECT_GT(changes("axes exchanged"), 0.1);
  EXPECT_GT(changes("dielectric"), 0.1);
  EXPECT_GT(changes("clearcoat"), 0.01);
  // Filters of 8 bits are off by a 500th of what neighbouring nodes differ by; SwiftShader's is
  // not.
  EXPECT_LT(changes("texture unit"), 0.01);
  if (result.contains("without_webgpu"))
    GTEST_SKIP() << "WebGL is as it should be; without WebGPU: " << result["without_webgpu"];
  for (const nlohmann::json& sphere : result["spheres"])
    for (const char* by : {"table", "field"}) {
      EXPECT_LT(sphere["webgpu_from_ltcfit"][by], by_mesh(sphere) + turns(sphere, by)) << sphere;
      EXPECT_LT(sphere["webgpu_from_webgl"][by], by_mesh(sphere)) << sphere;
    }
  for (const auto& [name, variant] : result["variants"].items())
    EXPECT_LT(variant["webgpu_from_webgl"], by_mesh(result["spheres"][0])) << name;
}

TEST_F(ThreeAnisotropic, RendersFoldedFieldsAsLtcfitDoes) {
  ASSERT_NO_FATAL_FAILURE(make_table_and_field());
  ASSERT_EQ(run_ltcfit({"generate", "--config", LTCFIT_SOURCE_DIR "/config/folded-field.toml", "-o",
                        "folded", "--set", "field.size=128"},
                       folder.path())
                .exit_code,
            0);
  const ProgramResult done = run("table/ltc.h5", "folded/ltc_field.json", LTCFIT_PROGRAM,
                                 {"--size", "96", "--samples", "256", "--material", "0.3,0.7",
                                  "--material", "0.3,0.7,90", "--material", "0.4,0"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json result = nlohmann::json::parse(read_file(folder / "figures.json"));
  ASSERT_EQ(result["spheres"].size(), 3u);
  for (const nlohmann::json& sphere : result["spheres"]) {
    EXPECT_GT(sphere["reference_mean"], 0.03) << sphere;
    EXPECT_LT(sphere["rays_from_ltcfit"]["field"], by_rays) << sphere;
    // Half as many pixels as above, which are half as many steps of the grid.
    EXPECT_LT(sphere["webgl_from_ltcfit"]["field"], 2 * by_mesh(sphere)) << sphere;
    if (sphere["webgpu_from_ltcfit"].contains("field")) {
      EXPECT_LT(sphere["webgpu_from_ltcfit"]["field"], 2 * by_mesh(sphere)) << sphere;
    }
  }
}

TEST_F(ThreeAnisotropic, WhatItCannotRenderIsRefused) {
  folder.write("no.h5", "not a table");
  const std::string program = LTCFIT_PROGRAM;
  for (const auto& [option, ltcfit, code, part] :
       {std::tuple("--material=0.3,1.5", program, 2, "--material is 0.3,1.5; allowed: a roughness"),
        std::tuple("--material=0.3,0.5,45", program, 2, "a rotation of 0 or 90"),
        std::tuple("--material=0.3,", program, 2, "--material is 0.3,; allowed"),
        std::tuple("--size=20", program, 2, "--size is 20; allowed: 16 to 1000, multiples of 8"),
        std::tuple("--f0=0.5", program, 2, "no.h5"),
        std::tuple("--f0=0.5", std::string("./none"), 1, "cannot run ./none")}) {
    const ProgramResult result = run("no.h5", "no.h5", ltcfit, {option});
    EXPECT_EQ(result.exit_code, code) << result.out;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(folder / "figures.json"));
  }
}

}  // namespace
}  // namespace ltc::test
