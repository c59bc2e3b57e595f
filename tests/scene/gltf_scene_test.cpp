// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>

#include "core/error.h"
#include "scene/scene.h"
#include "support/reference.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

using test::message_of;
using test::TemporaryDirectory;

// A glTF whose array of materials is given.
std::string gltf(const std::string& materials) {
  return R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "missing.bin", "byteLength": 12}],
             "materials": )" +
         materials + "}";
}

Scene load_text(const std::string& text) {
  const TemporaryDirectory folder;
  return load_scene(folder.write("scene.gltf", text));
}

PerceptualRoughness roughness_of(const Material& material) {
  return std::get<PerceptualRoughness>(material.roughness);
}

PerceptualRoughness only_material(const Scene& scene) {
  EXPECT_EQ(scene.materials.size(), 1u);
  return roughness_of(scene.materials.at(0));
}

void expect_one_warning(const Scene& scene, const std::vector<std::string>& parts) {
  ASSERT_EQ(scene.warnings.size(), 1u);
  test::expect_one_line(scene.warnings[0], parts);
}

PerceptualRoughness load_material(const std::string& material) {
  const Scene scene = load_text(gltf("[" + material + "]"));
  EXPECT_TRUE(scene.warnings.empty());
  return only_material(scene);
}

void expect_file_refused(const char* name, const std::string& content,
                         const std::vector<std::string>& parts) {
  const TemporaryDirectory folder;
  const auto file = folder.write(name, content);
  const std::string message = message_of<InputError>([&] { load_scene(file); });
  SCOPED_TRACE(content.substr(0, 200));
  test::expect_one_line(message, parts);
  EXPECT_TRUE(message.starts_with(file.string() + ": ")) << message;
  EXPECT_LT(message.size(), file.string().size() + 300) << message;
}

void expect_refused(const std::string& text, const std::vector<std::string>& parts) {
  expect_file_refused("bad.gltf", text, parts);
}

void expect_material_refused(const std::string& material, const std::vector<std::string>& parts) {
  expect_refused(gltf(R"([{}, )" + material + "]"), parts);
}

TEST(GltfScene, DefaultsAreThoseOfTheFormat) {
  EXPECT_EQ(load_material("{}"), (PerceptualRoughness{{1, 1}, {0, 0}}));
  EXPECT_EQ(load_material(R"({"pbrMetallicRoughness": {}, "extensions": {}})"),
            (PerceptualRoughness{{1, 1}, {0, 0}}));
}

TEST(GltfScene, FactorsAreRead) {
  EXPECT_EQ(load_material(R"({"pbrMetallicRoughness": {"roughnessFactor": 0.25},
                              "extensions": {"KHR_materials_anisotropy":
                                {"anisotropyStrength": 0.5, "anisotropyRotation": 1.5}}})"),
            (PerceptualRoughness{{0.25, 0.25}, {0.5, 0.5}}));
}

TEST(GltfScene, TexturesMeanFromZeroToTheFactor) {
  EXPECT_EQ(load_material(R"({"pbrMetallicRoughness": {"roughnessFactor": 0.25,
                                "metallicRoughnessTexture": {"index": 7}},
                              "extensions": {"KHR_materials_anisotropy":
                                {"anisotropyStrength": 0.5, "anisotropyTexture": {"index": 0}}}})"),
            (PerceptualRoughness{{0, 0.25}, {0, 0.5}}));
  EXPECT_EQ(
      load_material(R"({"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 7}}})"),
      (PerceptualRoughness{{0, 1}, {0, 0}}));
}

TEST(GltfScene, TheBarnLampReads) {
  const auto file = test::reference_file("gltf/AnisotropyBarnLamp.gltf");
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << "no " << file << "; set LTCFIT_REFERENCE_DIR to the folder that has it";
  const Interval all{0, std::numbers::pi / 2};
  EXPECT_EQ(load_scene(file).materials,
            (std::vector<Material>{
                {"Lamp Metal", PerceptualRoughness{{0, 1}, {0, 1}}, all},
                {"Lamp Metal (clear coat)", PerceptualRoughness{{0.15, 0.15}, {0, 0}}, all},
                {"Lamp Filament", PerceptualRoughness{{0.7, 0.7}, {0, 0}}, all},
                {"Lamp Glass", PerceptualRoughness{{0, 0}, {0, 0}}, all},
            }));
}

TEST(GltfScene, FilesThatAreNoGltf2AreRefused) {
  expect_refused("", {"not JSON at byte 1 of 0"});
  expect_refused("glTF is a format, not a file of it", {"binary glTF of version"});
  expect_refused("<html>", {"not JSON at byte 1 of 6"});
  const std::string whole = gltf("[{}]");
  EXPECT_EQ(load_text(whole).materials.size(), 1u);
  for (std::size_t size = 1; size < whole.size(); ++size)
    expect_refused(whole.substr(0, size), {"not JSON at byte"});
  expect_refused(whole + "}", {"not JSON"});
  expect_refused("{\"asset\": {\"version\": \"\xff\"}}", {"not JSON"});
  expect_refused("[]", {"asset.version", "glTF 2.0"});
  expect_refused("{}", {"asset.version", "glTF 2.0"});
  expect_refused(R"({"asset": 2, "materials": [{}]})", {"asset.version = null", "\"2.0\""});
  expect_refused(R"({"asset": {}, "materials": [{}]})", {"asset.version = null"});
  for (const char* version : {"2.0", "\"1.0\"", "\"3.0\"", "\"20\"", "\"\"", "[2]"})
    expect_refused(fmt::format(R"({{"asset": {{"version": {}}}, "materials": [{{}}]}})", version),
                   {"asset.version = ", "expected \"2.0\""});
}

TEST(GltfScene, ScenesWithoutMaterialAreRefused) {
  expect_refused(R"({"asset": {"version": "2.0"}})", {"has no material"});
  expect_refused(gltf("[]"), {"has no material"});
  expect_refused(gltf("{}"), {"materials = an object", "an array"});
  expect_refused(gltf("3"), {"materials = 3", "an array"});
}

TEST(GltfScene, WrongTypesInAMaterialAreRefused) {
  expect_material_refused("3", {"materials[1] = 3", "an object"});
  expect_material_refused(R"({"name": 3})", {"materials[1]: name = 3", "a string"});
  expect_material_refused(R"({"name": "a\nb", "pbrMetallicRoughness": 3})",
                          {R"(materials[1] "a\nb": pbrMetallicRoughness = 3: expected an object)"});
  expect_material_refused(R"({"pbrMetallicRoughness": null})", {"pbrMetallicRoughness = null"});
  expect_material_refused(R"({"extensions": []})", {"extensions = an array", "an object"});
  expect_material_refused(R"({"extensions": {"KHR_materials_anisotropy": 1}})",
                          {"extensions.KHR_materials_anisotropy = 1: expected an object"});
  for (const char* value :
       {"\"0.5\"", "null", "true", "[0.5]", "{}", "-0.1", "1.5", "2", "1e300"}) {
    const std::string part = ": expected a number in [0, 1]";
    expect_material_refused(
        fmt::format(R"({{"pbrMetallicRoughness": {{"roughnessFactor": {}}}}})", value),
        {"materials[1]: pbrMetallicRoughness.roughnessFactor = ", part});
    expect_material_refused(
        fmt::format(
            R"({{"extensions": {{"KHR_materials_anisotropy": {{"anisotropyStrength": {}}}}}}})",
            value),
        {"materials[1]: extensions.KHR_materials_anisotropy.anisotropyStrength = ", part});
  }
  for (const char* value : {"3", "null", "[]"})
    expect_material_refused(
        fmt::format(R"({{"pbrMetallicRoughness": {{"metallicRoughnessTexture": {}}}}})", value),
        {"pbrMetallicRoughness.metallicRoughnessTexture = ", "an object"});
  for (const char* value : {"{}", R"({"index": -1})", R"({"index": "a"})", R"({"index": 0.5})"})
    expect_material_refused(
        fmt::format(
            R"({{"extensions": {{"KHR_materials_anisotropy": {{"anisotropyTexture": {}}}}}}})",
            value),
        {"anisotropyTexture.index = ", "the number of a texture"});
}

TEST(GltfScene, MessagesStayShort) {
  expect_material_refused(
      fmt::format(R"({{"name": "{}", "extensions": 3}})", std::string(9999, 'x')),
      {"extensions = 3", "xxx..."});
  std::string accents;
  for (int i = 0; i < 999; ++i)
    accents += "\xc3\xa9";
  expect_material_refused(fmt::format(R"({{"name": "x{}", "extensions": 3}})", accents), {"..."});
}

TEST(GltfScene, NumbersAndNestingBeyondReasonAreRefused) {
  for (const char* number : {"1e999", "-1e999"})
    expect_refused(fmt::format(R"({{"asset": {{"version": "2.0"}},
                        "materials": [{{"pbrMetallicRoughness": {{"roughnessFactor": {}}}}}]}})",
                               number),
                   {"roughnessFactor = \"1e999\": expected a number in [0, 1]"});
  for (const int levels : {100, 1000000}) {
    const std::string nested = std::string(levels, '[') + std::string(levels, ']');
    expect_refused(gltf("[{}]").insert(1, "\"extras\": " + nested + ", "), {"deeper than 64"});
    expect_refused(gltf(R"([{"extras": )" + nested + "}]"), {"deeper than 64"});
    expect_refused(std::string(levels, '['), {"deeper than 64"});
  }
  const std::string fair = std::string(50, '[') + std::string(50, ']');
  EXPECT_EQ(load_material(R"({"extras": )" + fair + "}").roughness.low, 1);
}

// ---- The binary form ----

std::string word(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i)
    bytes += static_cast<char>(value >> (8 * i) & 255);
  return bytes;
}

struct Glb {
  std::string magic = "glTF";
  std::uint32_t version = 2;
  std::uint32_t length = 0;  // 0: the true one
  std::uint32_t json_bytes = 0;
  std::string chunk_type = "JSON";
  std::string json = gltf(R"([{"pbrMetallicRoughness": {"roughnessFactor": 0.5}}])");
  std::string rest = word(8) + std::string("BIN\0", 4) + "12345678";

  std::string bytes() const {
    const auto size = static_cast<std::uint32_t>(20 + json.size() + rest.size());
    return magic + word(version) + word(length ? length : size) +
           word(json_bytes ? json_bytes : static_cast<std::uint32_t>(json.size())) + chunk_type +
           json + rest;
  }
};

void expect_glb_refused(const Glb& glb, const std::vector<std::string>& parts) {
  expect_file_refused("bad.glb", glb.bytes(), parts);
}

TEST(GltfScene, TheBinaryFormReads) {
  const TemporaryDirectory folder;
  Glb padded;
  padded.json += "   ";
  for (const Glb& glb : {Glb{}, padded})
    for (const char* name : {"a.glb", "a.GLB", "a.gltf", "a"})
      EXPECT_EQ(load_scene(folder.write(name, glb.bytes())).materials.at(0).roughness,
                (std::variant<RoughnessBox, PerceptualRoughness>{
                    PerceptualRoughness{{0.5, 0.5}, {0, 0}}}));
}

TEST(GltfScene, DamagedBinaryFilesAreRefused) {
  const auto with = [](auto change) {
    Glb glb;
    change(glb);
    return glb;
  };
  expect_glb_refused(with([](Glb& g) { g.magic = "glTf"; }), {"does not begin with \"glTF\""});
  expect_glb_refused(with([](Glb& g) { g.version = 1; }), {"version 1", "version 2"});
  expect_glb_refused(with([](Glb& g) { g.length = 4000000000u; }), {"truncated", "4000000000"});
  expect_glb_refused(with([](Glb& g) { g.length = 19; }), {"damaged", "19 bytes"});
  expect_glb_refused(with([](Glb& g) { g.length = 25; }), {"damaged", "5 are left"});
  expect_glb_refused(with([](Glb& g) { g.json_bytes = 4294967295u; }), {"4294967295", "left"});
  expect_glb_refused(with([](Glb& g) { g.json_bytes = 10; }), {"not JSON"});
  expect_glb_refused(with([](Glb& g) { g.chunk_type = "BIN "; }), {"type JSON"});
  expect_glb_refused(with([](Glb& g) { g.json = ""; }), {"not JSON at byte 1 of 0"});
  expect_glb_refused(with([](Glb& g) { g.json = "{}"; }), {"asset.version"});
  const std::string whole = Glb{}.bytes();
  for (std::size_t size = 0; size < whole.size(); ++size)
    expect_file_refused("bad.glb", whole.substr(0, size), {"truncated"});
}

TEST(GltfScene, BytesAfterTheEndOfABinaryFileAreLeftOutWithAWarning) {
  const TemporaryDirectory folder;
  const Scene scene = load_scene(folder.write("long.glb", Glb{}.bytes() + "x"));
  EXPECT_EQ(only_material(scene), (PerceptualRoughness{{0.5, 0.5}, {0, 0}}));
  expect_one_warning(scene, {"long.glb", "left out what follows"});
}

// 256 MiB are too many to write in a test; a file with a hole has the size without the bytes.
TEST(GltfScene, MoreJsonThanThereCanBeIsRefused) {
  const TemporaryDirectory folder;
  constexpr std::uint32_t bytes = 300u << 20;
  Glb glb;
  glb.length = bytes;
  glb.json_bytes = bytes - 20;
  const auto file = folder.write("large.glb", glb.bytes());
  std::filesystem::resize_file(file, bytes);
  test::expect_one_line(message_of<InputError>([&] { load_scene(file); }),
                        {"314572780 bytes of JSON", "268435456"});
}

}  // namespace
}  // namespace ltc
