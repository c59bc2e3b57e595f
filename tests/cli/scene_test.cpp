// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit generate --scene and --extend, through the real program.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "brdf/separable_ggx.h"
#include "export/files.h"
#include "export/same_tables.h"
#include "export/table_file.h"
#include "scene/coverage.h"
#include "scene/scene.h"
#include "support/refused_run.h"
#include "table/synthetic.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;

// The paper's whole grid in the least time: the counts are what matters, not the matrices.
const std::vector<std::string> rough_fit = {
    "--set", "fit.gauss_newton.coarse_samples=64", "--set", "fit.gauss_newton.coarse_directions=4",
    "--set", "fit.gauss_newton.coarse_steps=1",    "--set", "fit.gauss_newton.samples=64",
    "--set", "fit.gauss_newton.directions=4",      "--set", "fit.gauss_newton.steps=1",
    "--set", "fit.gauss_newton.target_samples=64", "--set", "fit.gauss_newton.starts=1",
    "--set", "fit.gauss_newton.neighbour_sweeps=0"};

fs::path shipped(const std::string& name) {
  return fs::path(LTCFIT_SOURCE_DIR) / "config/scenes" / name;
}

std::vector<std::string> generate(std::vector<std::string> more) {
  std::vector<std::string> arguments = {"generate", "--set", "refine.steps=0"};
  arguments.insert(arguments.end(), rough_fit.begin(), rough_fit.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

void expect_line(const std::string& out, const std::string& line) {
  EXPECT_NE(out.find(line + "\n"), std::string::npos) << line << " is not in: " << out;
}

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b, std::size_t flat,
               std::size_t values = 1) {
  return std::memcmp(&a[values * flat], &b[values * flat], values * sizeof(T)) == 0;
}

bool same_entry(const Table& a, const Table& b, std::size_t flat) {
  return same_bits(a.stored, b.stored, flat, 9) && same_bits(a.amplitude, b.amplitude, flat) &&
         same_bits(a.fresnel, b.fresnel, flat) && same_bits(a.sw_loss, b.sw_loss, flat) &&
         same_bits(a.status, b.status, flat) && same_bits(a.iterations, b.iterations, flat);
}

// NaN and status 0 exactly where no look-up of the scene comes.
void expect_only_needed(const Table& table, const std::vector<bool>& needed) {
  for (std::size_t flat = 0; flat < needed.size(); ++flat) {
    const Eigen::Matrix3d stored = table.stored_at(flat);
    const float values[] = {table.amplitude[flat], table.fresnel[flat], table.sw_loss[flat]};
    EXPECT_EQ(has_values(table.status[flat]), needed[flat]) << flat;
    if (needed[flat]) {
      EXPECT_TRUE(stored.allFinite()) << flat;
    } else {
      EXPECT_EQ(table.status[flat], Status::skipped) << flat;
      EXPECT_TRUE(stored.array().isNaN().all()) << flat;
      EXPECT_EQ(table.iterations[flat], 0) << flat;
    }
    for (const float value : values)
      EXPECT_EQ(std::isfinite(value), needed[flat]) << flat;
  }
}

// ---- Scenes ----

TEST(GenerateScene, FitsWhatTheShippedScenesNeed) {
  struct Case {
    const char* scene;
    std::size_t needed, fitted, copied, analytic;
  };
  // As in docs/scenes.md, which counts the analytic among the fitted. Brushed metal's cell is
  // beyond alpha = 4/7; of the isotropic slice the seven sharpest lobes have a closed form.
  for (const Case& c :
       {Case{"brushed-metal", 256, 228, 28, 0}, Case{"isotropic-game", 512, 57, 448, 7},
        Case{"everything", 4096, 2850, 1239, 7}}) {
    SCOPED_TRACE(c.scene);
    const TemporaryDirectory folder;
    const fs::path scene = shipped(std::string(c.scene) + ".toml");
    const ProgramResult result = run_ltcfit(generate({"--scene", scene.string()}), folder.path());
    ASSERT_EQ(result.exit_code, 0) << result.err;
    expect_line(result.out,
                fmt::format("entries  4096: {} fitted, {} copied by symmetry, {} analytic, {} "
                            "skipped, 0 failed",
                            c.fitted, c.copied, c.analytic, 4096 - c.needed));
    if (c.needed < 4096) {
      expect_line(result.out, fmt::format("scene    {} of 4096 entries needed", c.needed));
      EXPECT_NE(result.out.find(
                    fmt::format(": {} lobes fitted instead of 2857\n", c.fitted + c.analytic)),
                std::string::npos)
          << result.out;
    } else {
      EXPECT_EQ(result.out.find("scene  "), std::string::npos) << result.out;
    }
    const Table table = read_table(folder / "out/ltc.h5");
    const std::vector<bool> needed = needed_entries(load_scene(scene), table.grid);
    EXPECT_EQ(static_cast<std::size_t>(std::count(needed.begin(), needed.end(), true)), c.needed);
    expect_only_needed(table, needed);
    // No NaN in textures, whose entries are those of the HDF5 file where it has any.
    const Table textures = read_table(folder / "out/ltc.0.exr");
    for (const auto* values : {&textures.stored, &textures.amplitude, &textures.fresnel})
      for (const float value : *values)
        ASSERT_TRUE(std::isfinite(value));
    const Table array = read_table(folder / "out/ltc.npy");
    for (std::size_t flat = 0; flat < needed.size(); ++flat)
      if (needed[flat]) {
        EXPECT_TRUE(same_bits(textures.stored, table.stored, flat, 9)) << flat;
        EXPECT_TRUE(same_bits(textures.fresnel, table.fresnel, flat)) << flat;
        EXPECT_TRUE(same_bits(array.stored, table.stored, flat, 9)) << flat;
      } else {
        EXPECT_EQ(array.status[flat], Status::skipped) << flat;
      }
  }
}

TEST(GenerateScene, LeavesTheArrayOutOnOtherGridsAndSaysSo) {
  const TemporaryDirectory folder;
  const fs::path scene = shipped("brushed-metal.toml");
  const ProgramResult result = run_ltcfit(
      generate({"--scene", scene.string(), "--set", "table.alpha.warp=sqrt"}), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in(folder / "out"),
            (std::vector<std::string>{"ltc.0.exr", "ltc.1.exr", "ltc.2.exr", "ltc.h5"}));
  expect_line(result.out, "no NPY   it holds the paper's grid only");
  EXPECT_EQ(result.out.find("ltc.npy"), std::string::npos) << result.out;
}

// ---- Extending ----

TEST(GenerateExtend, KeepsWhatThereIsAndAddsWhatIsLacking) {
  const TemporaryDirectory folder;
  const std::string brushed = shipped("brushed-metal.toml").string();
  const std::string isotropic = shipped("isotropic-game.toml").string();
  const auto run = [&](std::vector<std::string> more, const std::string& output) {
    more.insert(more.end(), {"--output", output});
    const ProgramResult result = run_ltcfit(generate(more), folder.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  };
  run({"--scene", brushed}, "first");
  run({"--scene", isotropic}, "alone");
  // More steps than the first run's: the entries kept are not those of a new fit.
  const std::string out =
      run({"--scene", isotropic, "--extend", "first/ltc.h5", "--set", "fit.gauss_newton.steps=2"},
          "second");
  const Table first = read_table(folder / "first/ltc.h5");
  const Table alone = read_table(folder / "alone/ltc.h5");
  const Table second = read_table(folder / "second/ltc.h5");
  const std::vector<bool> needed = needed_entries(load_scene(isotropic), first.grid);
  std::size_t kept = 0, added = 0, differ = 0;
  for (std::size_t flat = 0; flat < first.grid.size(); ++flat) {
    if (first.status[flat] != Status::skipped) {
      EXPECT_TRUE(same_entry(second, first, flat)) << flat;
      ++kept;
    } else {
      EXPECT_EQ(has_values(second.status[flat]), needed[flat]) << flat;
      EXPECT_EQ(second.stored_at(flat).allFinite(), needed[flat]) << flat;
      added += needed[flat];
      differ += needed[flat] && !same_entry(second, alone, flat);
    }
  }
  EXPECT_EQ(kept, 256u);
  EXPECT_GT(added, 300u);
  EXPECT_GT(differ, 0u);
  expect_line(out, fmt::format("extended {} entries added, the others kept", added));

  // Once more there is nothing to add: the table stays as it is, in the same file too.
  const std::string bytes = read_file(folder / "second/ltc.h5");
  const std::string again = run({"--scene", isotropic, "--extend", "second/ltc.h5"}, "second");
  expect_line(again, "extended 0 entries added, the others kept");
  EXPECT_EQ(read_file(folder / "second/ltc.h5"), bytes);
}

// ---- What is refused ----

void expect_scene_refused(const std::string& name, std::string_view content,
                          const std::vector<std::string>& parts) {
  SCOPED_TRACE(content);
  const TemporaryDirectory scenes;
  const fs::path file = scenes.write(name, content);
  std::vector<std::string> all = parts;
  all.push_back(file.string() + ":");
  expect_refused({"generate", "--scene", file.string()}, 2, all);
}

TEST(GenerateSceneBadInput, Toml) {
  const std::string head = "[[material]]\nname = \"m\"\n";
  const auto expect = [](const std::string& text, const std::vector<std::string>& parts) {
    expect_scene_refused("bad.toml", text, parts);
  };
  expect("", {"has no material"});
  expect("material = []\n", {"at least one"});
  expect(head + "roughness = 1.5\n", {":3: ", "roughness = 1.5", "[0, 1]"});
  expect(head + "roughness = -0.1\n", {":3: ", "roughness = -0.1", "[0, 1]"});
  expect(head + "alpha_x = 2\nalpha_y = 0.1\n", {":3: ", "alpha_x = 2", "[0, 1]"});
  expect(head + "roughness = [0.5, 0.2]\n", {":3: ", "roughness = [0.5, 0.2]", "[low, high]"});
  expect(head + "roughnes = 0.5\n", {":3: ", "\"roughnes\"", "did you mean roughness?"});
  expect(head + "roughness = \"low\"\n", {":3: ", "roughness = \"low\"", "a number"});
  expect("[[material\n", {":1: ", "not TOML"});
}

TEST(GenerateSceneBadInput, Gltf) {
  const auto expect = [](const std::string& text, const std::vector<std::string>& parts) {
    expect_scene_refused("bad.gltf", text, parts);
  };
  const std::string good = R"({"asset": {"version": "2.0"}, "materials": [{}]})";
  expect(good.substr(0, good.size() / 2), {"not JSON at byte"});
  expect("", {"not JSON"});
  expect("<html>", {"not JSON"});
  expect(R"({"asset": {"version": "1.0"}, "materials": [{}]})", {"asset.version = \"1.0\"", "2.0"});
  expect(R"({"asset": {"version": "2.0"}})", {"has no material"});
  expect(R"({"asset": {"version": "2.0"}, "materials": [3]})", {"materials[0] = 3", "an object"});
  expect(R"({"asset": {"version": "2.0"}, "materials":
             [{"pbrMetallicRoughness": {"roughnessFactor": "0.5"}}]})",
         {"roughnessFactor = ", "a number in [0, 1]"});
  expect(R"({"asset": {"version": "2.0"}, "materials":
             [{"pbrMetallicRoughness": {"roughnessFactor": 1.5}}]})",
         {"roughnessFactor = 1.5", "[0, 1]"});
  // A binary file cut short.
  expect_scene_refused("bad.glb", std::string("glTF\2\0\0\0\x40\0\0\0", 12), {"bad.glb"});
}

TEST(GenerateSceneBadInput, FilesThatCannotBeRead) {
  expect_refused({"generate", "--scene", "none.toml"}, 3, {"none.toml", "No such file"});
  expect_refused({"generate", "--scene", "none.gltf"}, 3, {"none.gltf", "No such file"});
  expect_refused({"generate", "--scene", "/"}, 3, {"/", "folder"});
  expect_refused({"generate", "--extend", "none.h5"}, 3, {"none.h5", "No such file"});
}

TEST(GenerateExtendBadInput, AnotherKindOfTable) {
  const TemporaryDirectory tables;
  const auto expect = [&](const std::string& name, const Table& table,
                          const std::vector<std::string>& parts) {
    write_table(table, tables / name);
    std::vector<std::string> all = parts;
    all.push_back((tables / name).string());
    expect_refused({"generate", "--extend", (tables / name).string()}, 2, all);
  };
  const Table good = testing::synthetic_table(Grid::paper(8), Storage::matrix);
  Table other = good;
  other.grid.model = &test::separable_ggx();
  expect("brdf.h5", other, {"BRDF \"separable-ggx\"", "expected one of: ggx"});
  other = good;
  other.storage = Storage::mirror_frame;
  expect("storage.h5", other, {"storage is \"mirror-frame\"", "expected \"matrix\""});
  expect("shape.h5", testing::synthetic_table(Grid::paper({7, 8, 8, 8}), Storage::matrix),
         {"alpha axis is 7 nodes", "expected 8 nodes"});
  other = good;
  other.grid.alpha_min = 1e-5;
  expect("least.h5", other, {"alpha_min is 1e-05", "expected 0.0001"});
}

TEST(GenerateExtendBadInput, FilesThatAreNoTable) {
  const TemporaryDirectory tables;
  const fs::path garbage = tables.write("garbage.h5", "no table at all");
  expect_refused({"generate", "--extend", garbage.string()}, 2, {"garbage.h5"});
  // Another format version, and other damages that h5py can do.
  write_table(testing::synthetic_table(testing::uneven_grid(), Storage::mirror_frame),
              tables / "good.h5");
  const testing::Finished damaged = testing::run_python(
      "damage_h5.py", (tables / "good.h5").string() + " " + tables.path().string());
  ASSERT_EQ(damaged.exit_code, 0) << damaged.output;
  expect_refused({"generate", "--extend", (tables / "version_2.h5").string()}, 2,
                 {"version_2.h5", "format_version is 2; allowed: 1"});
  expect_refused({"generate", "--extend", (tables / "other_format.h5").string()}, 2,
                 {"other_format.h5", "format is \"lut\""});
}

// ---- What a scene's file is warned of ----

TEST(SceneWarnings, AreToldALineEach) {
  const TemporaryDirectory folder;
  folder.write("odd.gltf", R"({"asset": {"version": "2.0"},
      "cameras": [1e309], "extensionsUsed": ["NV_materials_mdl"],
      "materials": [{"pbrMetallicRoughness": {"roughnessFactor": 0.5}}]})");
  const ProgramResult result =
      run_ltcfit(generate({"--scene", "odd.gltf", "--output", "out"}), folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("ltcfit: warning: odd.gltf: left out 1 number too large for a double\n"
                            "ltcfit: warning: odd.gltf: NV_materials_mdl may change"),
            std::string::npos)
      << result.err;
}

}  // namespace
}  // namespace ltc::test
