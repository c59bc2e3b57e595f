// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include <gtest/gtest.h>

#include <numbers>

#include "core/error.h"
#include "scene/scene.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

using test::message_of;
using test::TemporaryDirectory;

Scene load_text(std::string_view text) {
  const TemporaryDirectory folder;
  return load_scene(folder.write("scene.toml", text));
}

// A material's keys but for its name.
Material load_material(const std::string& keys) {
  const Scene scene = load_text("[[material]]\nname = \"m\"\n" + keys + "\n");
  EXPECT_EQ(scene.materials.size(), 1u);
  return scene.materials.at(0);
}

PerceptualRoughness perceptual(const Material& material) {
  return std::get<PerceptualRoughness>(material.roughness);
}

void expect_refused(std::string_view text, const std::vector<std::string>& parts) {
  const TemporaryDirectory folder;
  const auto file = folder.write("bad.toml", text);
  const std::string message = message_of<InputError>([&] { load_scene(file); });
  SCOPED_TRACE(text);
  test::expect_one_line(message, parts);
  EXPECT_TRUE(message.starts_with(file.string() + ":")) << message;
}

void expect_material_refused(const std::string& keys, const std::vector<std::string>& parts) {
  expect_refused("[[material]]\nname = \"m\"\n" + keys + "\n", parts);
}

TEST(LobeRoughness, IsThatOfGltf) {
  // alpha = 0.25; mix(0.25, 1, 0.25) = 0.4375: exact in binary.
  const LobeRoughness lobe = lobe_roughness(0.5, 0.5);
  EXPECT_EQ(lobe.alpha_x, 0.4375);
  EXPECT_EQ(lobe.alpha_y, 0.25);
  for (int i = 0; i <= 1000; ++i) {
    const double value = i / 1000.0;
    const LobeRoughness isotropic = lobe_roughness(value, 0), brushed = lobe_roughness(value, 1);
    EXPECT_EQ(isotropic.alpha_x, isotropic.alpha_y);
    EXPECT_EQ(brushed.alpha_x, 1);
    EXPECT_GE(lobe_roughness(1, value).alpha_x, 1);
    EXPECT_LE(lobe_roughness(value, 0.7).alpha_x, 1);
  }
}

TEST(TomlScene, ReadsValuesAndRanges) {
  const Scene scene = load_text(R"(
[[material]]
name = "a"
alpha_x = 0.5
alpha_y = [0.1, 0.25]

[[material]]
name = "b"
roughness = [0, 1]
anisotropy = 0.75
view_angle_degrees = [30, 60.0]

[[material]]
name = "a"
roughness = 1
)");
  ASSERT_EQ(scene.materials.size(), 3u);
  const double right_angle = std::numbers::pi / 2;
  EXPECT_EQ(scene.materials[0],
            (Material{"a", RoughnessBox{{0.5, 0.5}, {0.1, 0.25}}, {0, right_angle}}));
  EXPECT_EQ(scene.materials[1],
            (Material{"b",
                      PerceptualRoughness{{0, 1}, {0.75, 0.75}},
                      {30 * (std::numbers::pi / 180), 60 * (std::numbers::pi / 180)}}));
  EXPECT_EQ(perceptual(scene.materials[2]), (PerceptualRoughness{{1, 1}, {0, 0}}));
}

TEST(TomlScene, TheRightAngleIsExact) {
  EXPECT_EQ(load_material("roughness = 1\nview_angle_degrees = [0, 90]").theta_radians,
            (Interval{0, std::numbers::pi / 2}));
}

TEST(TomlScene, ScenesWithoutMaterialAreRefused) {
  expect_refused("", {"has no material", "[[material]]"});
  expect_refused("material = []", {":1: material", "at least one"});
  expect_refused("material = [1, 2]", {":1: material = [1, 2]", "[[material]]"});
  expect_refused("material = [[], 2]", {":1: material", "[[material]]"});
  expect_refused("material = 3", {"material = 3", "[[material]]"});
  expect_refused("[material]\nname = \"m\"\nroughness = 1", {":1: material", "[[material]]"});
}

TEST(TomlScene, UnknownKeysAreNamedWithTheNearest) {
  expect_material_refused(
      "roughnes = 0.5",
      {":3: material 1 \"m\"", "unknown key \"roughnes\" = 0.5", "did you mean roughness?"});
  expect_material_refused("roughness = 1\nview_angle = [0, 1]", {":4:", "\"view_angle\" = [0, 1]"});
  expect_material_refused("roughness = 1\ncolour = \"red\"",
                          {"\"colour\" = \"red\"", "docs/scenes"});
  expect_material_refused("roughness = 1\n\"a\\nb\" = 1", {"unknown key \"a\\u000Ab\""});
  expect_refused("[[materials]]\nname = \"m\"", {":1: unknown key \"materials\"", "[[material]]"});
}

TEST(TomlScene, NamesAreNeeded) {
  expect_refused("[[material]]\nroughness = 1", {":1: material 1: has no name"});
  expect_refused("[[material]]\nname = 1\nroughness = 1", {":2: material 1: name = 1", "a string"});
  expect_refused("[[material]]\nname = \"\"\nroughness = 1", {"name = \"\"", "not empty"});
  expect_refused("[[material]]\nname = \"a\"\nroughness = 1\n[[material]]\nname = \"b\\n\"",
                 {":4: material 2 \"b\\u000A\": has no roughness"});
}

TEST(TomlScene, ValuesOutsideTheirRangeAreRefused) {
  for (const char* key : {"roughness", "anisotropy", "alpha_x", "alpha_y"})
    for (const char* value : {"-0.1", "1.5", "2", "nan", "inf", "\"rough\"", "true", "[0.5, 0.2]",
                              "[0.5]", "[0.1, 0.2, 0.3]", "[0.1, 2.0]", "[-1, 0.5]", "[nan, 1]",
                              "[0, \"a\"]", "[]", "[[0, 1], 1]", "{low = 0}", "1979-05-27"})
      expect_material_refused(std::string(key) + " = " + value,
                              {":3: material 1 \"m\": " + std::string(key) + " = ",
                               "expected a number in [0, 1], or two, [low, high]"});
  expect_material_refused("roughness = [0.5, 0.2]", {"roughness = [0.5, 0.2]: expected"});
  expect_material_refused("roughness = 1\nview_angle_degrees = [0, 91]",
                          {":4:", "view_angle_degrees = [0, 91]", "[0, 90]"});
  expect_material_refused("roughness = 1\nview_angle_degrees = [60, 30]", {"low <= high"});
}

TEST(TomlScene, RoughnessIsSaidInOneWay) {
  expect_material_refused("", {"has no roughness", "alpha_x and alpha_y", "roughness"});
  expect_material_refused("anisotropy = 0.5", {"has anisotropy; expected"});
  expect_material_refused("alpha_x = 0.5", {"has alpha_x; expected alpha_x and alpha_y"});
  expect_material_refused("alpha_x = 0.5\nroughness = 0.5", {"has alpha_x, roughness; expected"});
  expect_material_refused("alpha_x = 0.5\nalpha_y = 0.5\nanisotropy = 0.5",
                          {"has alpha_x, alpha_y, anisotropy; expected"});
}

TEST(TomlScene, BrokenSyntaxIsNamedWithTheLine) {
  expect_refused("[[material]]\nname = \n", {":2: not TOML"});
  expect_refused("[[material]", {":1: not TOML"});
  expect_refused(std::string("\xff\xfe\0", 3), {":1: not TOML"});
  expect_refused("material = " + std::string(100000, '['), {":1: not TOML"});
}

TEST(TomlScene, FilesThatCannotBeReadAreIoErrors) {
  const TemporaryDirectory folder;
  for (const char* name : {"none.toml", "none.gltf", "none.glb", "none"}) {
    const auto file = folder / name;
    test::expect_one_line(message_of<IoError>([&] { load_scene(file); }),
                          {"cannot read scene " + file.string()});
  }
  test::expect_one_line(message_of<IoError>([&] { load_scene(folder.path()); }), {"is a folder"});
  test::expect_one_line(message_of<InputError>([] { load_scene("/dev/zero"); }), {"larger than"});
}

TEST(Scene, TheEndingSaysTheFormatElseTheContentDoes) {
  const TemporaryDirectory folder;
  const std::string toml = "[[material]]\nname = \"m\"\nroughness = 0.5\n";
  const std::string gltf = R"( {"asset": {"version": "2.0"}, "materials": [{"name": "m"}]})";
  for (const char* name : {"a.toml", "a.TOML", "a", "a.txt"})
    EXPECT_EQ(perceptual(load_scene(folder.write(name, toml)).materials.at(0)).roughness.low, 0.5);
  for (const char* name : {"b.gltf", "b.GLTF", "b", "b.json"})
    EXPECT_EQ(perceptual(load_scene(folder.write(name, gltf)).materials.at(0)).roughness.low, 1);
  EXPECT_THROW(load_scene(folder.write("c.toml", gltf)), InputError);
  EXPECT_THROW(load_scene(folder.write("c.gltf", toml)), InputError);
}

}  // namespace
}  // namespace ltc
