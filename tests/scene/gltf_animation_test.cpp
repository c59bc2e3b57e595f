// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Animations of a material's roughness: how far they go, by what the file says or holds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "scene/scene.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

using test::TemporaryDirectory;

const std::string roughness_pointer = "/materials/0/pbrMetallicRoughness/roughnessFactor";

// A file of one material of roughness 0.5, and a sampler whose output is accessor 0.
struct Animated {
  std::string pointer = roughness_pointer;
  std::string accessor = R"({"componentType": 5126, "count": 2, "type": "SCALAR"})";
  std::string interpolation = "LINEAR";
  std::string material = R"({"pbrMetallicRoughness": {"roughnessFactor": 0.5}})";
  std::string more = "";  // other members

  std::string text() const {
    return fmt::format(
        R"({{"asset": {{"version": "2.0"}}, "materials": [{}], "accessors": [{}], {}
            "animations": [{{"samplers": [{{"input": 9, "output": 0, "interpolation": "{}"}}],
              "channels": [{{"sampler": 0, "target": {{"path": "pointer", "extensions":
                {{"KHR_animation_pointer": {{"pointer": "{}"}}}}}}}}]}}]}})",
        material, accessor, more, interpolation, pointer);
  }
};

Scene load(const Animated& animated) {
  const TemporaryDirectory folder;
  return load_scene(folder.write("scene.gltf", animated.text()));
}

PerceptualRoughness perceptual(const Scene& scene, std::size_t material = 0) {
  return std::get<PerceptualRoughness>(scene.materials.at(material).roughness);
}

void expect_range(const Animated& animated, const Interval& expected) {
  const Scene scene = load(animated);
  EXPECT_EQ(perceptual(scene).roughness, expected) << animated.text();
  EXPECT_EQ(scene.warnings, std::vector<std::string>{});
}

void expect_unknown(const Animated& animated) {
  const Scene scene = load(animated);
  EXPECT_EQ(perceptual(scene).roughness, (Interval{0, 1})) << animated.text();
  ASSERT_EQ(scene.warnings.size(), 1u);
  test::expect_one_line(scene.warnings[0],
                        {"scene.gltf", "does not tell how far", roughness_pointer});
}

std::string accessor_of(const std::string& members) {
  return R"({"count": 2, "type": "SCALAR", )" + members + "}";
}

TEST(GltfAnimation, GoesAsFarAsMinAndMaxSay) {
  Animated animated;
  animated.accessor = accessor_of(R"("componentType": 5126, "min": [0.25], "max": [0.75])");
  for (const char* interpolation : {"LINEAR", "STEP"}) {
    animated.interpolation = interpolation;
    expect_range(animated, {0.25, 0.75});
  }
  // What the material says itself it shows where no animation is played.
  animated.accessor = accessor_of(R"("componentType": 5126, "min": [0.625], "max": [0.75])");
  expect_range(animated, {0.5, 0.75});
  animated.accessor = accessor_of(R"("componentType": 5126, "min": [-3], "max": [7])");
  expect_range(animated, {0, 1});
  animated.accessor =
      accessor_of(R"("componentType": 5121, "normalized": true, "min": [51], "max": [255])");
  expect_range(animated, {0.2, 1});
  animated.material = R"({"pbrMetallicRoughness": {"roughnessFactor": 0.5,
                                                   "metallicRoughnessTexture": {"index": 0}}})";
  animated.accessor = accessor_of(R"("componentType": 5126, "min": [0.25], "max": [0.75])");
  expect_range(animated, {0, 0.75});
}

TEST(GltfAnimation, GoesAnywhereWhereTheFileDoesNotTell) {
  Animated spline;
  spline.accessor = accessor_of(R"("componentType": 5126, "min": [0.25], "max": [0.75])");
  spline.interpolation = "CUBICSPLINE";
  expect_unknown(spline);
  for (const char* accessor :
       {R"({"componentType": 5126, "count": 2, "type": "SCALAR"})", "3", "",
        R"({"componentType": 5126, "type": "VEC2", "min": [0, 0], "max": [0.1, 0.1]})",
        R"({"componentType": 5121, "type": "SCALAR", "min": [0], "max": [1]})",
        R"({"componentType": 5126, "type": "SCALAR", "min": [1e309], "max": [1]})",
        R"({"componentType": 5126, "type": "SCALAR", "min": [1], "max": [0]})"}) {
    Animated animated;
    animated.accessor = accessor;
    Scene scene = load(animated);
    EXPECT_EQ(perceptual(scene).roughness, (Interval{0, 1})) << accessor;
    ASSERT_FALSE(scene.warnings.empty());
    test::expect_one_line(scene.warnings.back(), {"does not tell how far"});
  }
}

TEST(GltfAnimation, OfOtherThingsChangesNothing) {
  Animated animated;
  animated.accessor = accessor_of(R"("componentType": 5126, "min": [0.25], "max": [0.75])");
  for (const char* pointer :
       {"/materials/1/pbrMetallicRoughness/roughnessFactor",
        "/materials/0/pbrMetallicRoughness/metallicFactor",
        "/materials/0/pbrMetallicRoughness/metallicRoughnessTexture/extensions/"
        "KHR_texture_transform/offset",
        "", "/"}) {
    animated.pointer = pointer;
    expect_range(animated, {0.5, 0.5});
  }
}

TEST(GltfAnimation, ReachesEveryNumberOfALobe) {
  Animated animated;
  animated.accessor = accessor_of(R"("componentType": 5126, "min": [0.25], "max": [0.75])");
  const std::string extensions = "/materials/0/extensions/";
  animated.pointer = extensions + "KHR_materials_anisotropy/anisotropyStrength";
  EXPECT_EQ(perceptual(load(animated)).anisotropy, (Interval{0, 0.75}));
  animated.pointer = extensions + "KHR_materials_clearcoat/clearcoatFactor";
  EXPECT_EQ(perceptual(load(animated), 1), (PerceptualRoughness{{0, 0}, {0, 0}}));
  animated.material = R"({"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}})";
  animated.pointer = extensions + "KHR_materials_clearcoat/clearcoatRoughnessFactor";
  EXPECT_EQ(perceptual(load(animated), 1).roughness, (Interval{0, 0.75}));
  animated.material = R"({"extensions": {"KHR_materials_pbrSpecularGlossiness": {}}})";
  animated.pointer = extensions + "KHR_materials_pbrSpecularGlossiness/glossinessFactor";
  EXPECT_EQ(perceptual(load(animated)).roughness, (Interval{0, 0.75}));
}

// ---- Values in buffers ----

std::string bytes_of(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values)
    for (int shift = 0; shift < 32; shift += 8)
      bytes += static_cast<char>(std::bit_cast<std::uint32_t>(value) >> shift & 255);
  return bytes;
}

// One value of no interest before the view, one before the accessor; 0.25, 0.75 and, by the stride,
// one between them that is skipped.
const std::vector<float> stored = {9, 9, 0.25f, 9, 0.75f};
// The same in base 64, as Python's base64.b64encode(struct.pack("<5f", ...)) has it.
const std::string stored_uri = "data:application/octet-stream;base64,AAAQQQAAEEEAAIA+AAAQQQAAQD8=";

Animated with_buffer(const std::string& buffer) {
  Animated animated;
  animated.accessor = accessor_of(R"("componentType": 5126, "bufferView": 0, "byteOffset": 4)");
  animated.more = R"("bufferViews": [{"buffer": 0, "byteOffset": 4, "byteLength": 16,
                                      "byteStride": 8}], "buffers": [)" +
                  buffer + "],";
  return animated;
}

TEST(GltfAnimation, GoesAsFarAsTheValuesOfADataUri) {
  expect_range(with_buffer(fmt::format(R"({{"uri": "{}", "byteLength": 20}})", stored_uri)),
               {0.25, 0.75});
}

TEST(GltfAnimation, GoesAsFarAsTheValuesOfAFileBesideIt) {
  const TemporaryDirectory folder;
  folder.write("values.bin", bytes_of(stored));
  const auto file = folder.write("scene.gltf", with_buffer(R"({"uri": "values.bin"})").text());
  EXPECT_EQ(perceptual(load_scene(file)).roughness, (Interval{0.25, 0.75}));
}

TEST(GltfAnimation, GoesAsFarAsTheValuesOfTheBinaryForm) {
  const auto word = [](std::size_t value) {
    return bytes_of({std::bit_cast<float>(static_cast<std::uint32_t>(value))});
  };
  const std::string json = with_buffer("{}").text(), binary = bytes_of(stored);
  const TemporaryDirectory folder;
  const auto file = folder.write(
      "scene.glb", "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) +
                       "JSON" + json + word(binary.size()) + std::string("BIN\0", 4) + binary);
  const Scene scene = load_scene(file);
  EXPECT_EQ(perceptual(scene).roughness, (Interval{0.25, 0.75}));
  EXPECT_EQ(scene.warnings, std::vector<std::string>{});
}

TEST(GltfAnimation, WholeNumbersAreSharesOfTheLargest) {
  Animated animated;
  animated.more = R"("bufferViews": [{"buffer": 0, "byteLength": 4}],
                     "buffers": [{"uri": "data:;base64,Mw=="}, {"uri": "data:;base64,M/8AgA=="}],)";
  const auto type = [&](int component, int begin) {
    animated.accessor = accessor_of(
        fmt::format(R"("componentType": {}, "normalized": true, "bufferView": 0, "byteOffset": {})",
                    component, begin));
  };
  type(5121, 0);  // the buffer is too short for two
  expect_unknown(animated);
  animated.more.replace(animated.more.find("\"buffer\": 0"), 11, "\"buffer\": 1");
  expect_range(animated, {0.2, 1});  // 51 and 255
  type(5120, 1);                     // -1 and 0
  expect_range(animated, {0, 0.5});
  type(5122, 0);  // 0xff33 and 0x8000, both below 0
  expect_range(animated, {0, 0.5});
  type(5123, 0);
  const Interval shares = perceptual(load(animated)).roughness;
  EXPECT_EQ(shares, (Interval{0.5, 0xff33 / 65535.0}));
}

TEST(GltfAnimation, BuffersThatDoNotHoldTheValuesTellNothing) {
  for (const char* buffer :
       {R"({"uri": "missing.bin"})", R"({"uri": "/dev/zero"})", R"({"uri": "../values.bin"})",
        R"({"uri": "data:;base64,AAAQ"})", R"({"uri": "data:,text"})", R"({"uri": 3})", "{}", "3"})
    expect_unknown(with_buffer(buffer));
  const auto changed = [](const std::string& from, const std::string& to) {
    Animated animated = with_buffer(fmt::format(R"({{"uri": "{}"}})", stored_uri));
    for (std::string* text : {&animated.accessor, &animated.more})
      if (const std::size_t at = text->find(from); at != std::string::npos)
        text->replace(at, from.size(), to);
    return animated;
  };
  expect_unknown(changed("\"count\": 2", "\"count\": 3"));
  expect_unknown(changed("\"count\": 2", "\"count\": 4294967295"));
  expect_unknown(changed("\"count\": 2", "\"count\": 18446744073709551615"));
  expect_unknown(changed("\"count\": 2", "\"count\": 0"));
  expect_unknown(changed("\"byteStride\": 8", "\"byteStride\": 1"));
  expect_unknown(changed("\"byteOffset\": 4, \"byteLength\": 16", "\"byteOffset\": -4"));
  expect_unknown(changed("\"byteLength\": 16", "\"byteLength\": 12"));
  expect_unknown(changed("\"bufferView\": 0", "\"bufferView\": 1"));
  expect_unknown(changed("\"count\": 2", "\"count\": 2, \"sparse\": {}"));
}

}  // namespace
}  // namespace ltc
