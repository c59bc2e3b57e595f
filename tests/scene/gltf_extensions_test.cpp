// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the extensions of glTF do to the lobes of its materials, and primitives without a material.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "scene/scene.h"
#include "support/reference.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

using test::message_of;
using test::TemporaryDirectory;

constexpr Interval none{0, 0};

Scene load_members(const std::string& members) {
  const TemporaryDirectory folder;
  return load_scene(
      folder.write("scene.gltf", R"({"asset": {"version": "2.0"}, )" + members + "}"));
}

Scene load_materials(const std::string& materials) {
  return load_members("\"materials\": [" + materials + "]");
}

PerceptualRoughness roughness_of(const Material& material) {
  return std::get<PerceptualRoughness>(material.roughness);
}

PerceptualRoughness only_material(const Scene& scene) {
  EXPECT_EQ(scene.materials.size(), 1u);
  return roughness_of(scene.materials.at(0));
}

void expect_refused(const std::string& members, const std::vector<std::string>& parts) {
  test::expect_one_line(message_of<InputError>([&] { load_members(members); }), parts);
}

// ---- Specular and glossiness ----

std::string glossy(const std::string& members) {
  return R"({"pbrMetallicRoughness": {"roughnessFactor": 0.9},
             "extensions": {"KHR_materials_pbrSpecularGlossiness": {)" +
         members + "}}}";
}

TEST(GltfExtensions, GlossinessIsTheOtherEndOfRoughness) {
  const auto of = [](const std::string& members) {
    return only_material(load_materials(glossy(members))).roughness;
  };
  EXPECT_EQ(of(""), (Interval{0, 0}));  // 1 if it is left out
  EXPECT_EQ(of(R"("glossinessFactor": 0.75)"), (Interval{0.25, 0.25}));
  EXPECT_EQ(of(R"("specularGlossinessTexture": {"index": 0})"), (Interval{0, 1}));
  EXPECT_EQ(of(R"("glossinessFactor": 0.75, "specularGlossinessTexture": {"index": 0})"),
            (Interval{0.25, 1}));
  expect_refused("\"materials\": [" + glossy(R"("glossinessFactor": 2)") + "]",
                 {"KHR_materials_pbrSpecularGlossiness.glossinessFactor = 2", "[0, 1]"});
}

// ---- Clear coat ----

TEST(GltfExtensions, AClearCoatIsALobeOfItsOwn) {
  const auto coated = [](const std::string& members) {
    return load_materials(R"({"name": "car", "pbrMetallicRoughness": {"roughnessFactor": 0.4},
        "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 0.5},
                       "KHR_materials_clearcoat": {)" +
                          members + "}}}");
  };
  for (const char* no_coat : {"", R"("clearcoatRoughnessFactor": 0.3)", R"("clearcoatFactor": 0)"})
    EXPECT_EQ(only_material(coated(no_coat)), (PerceptualRoughness{{0.4, 0.4}, {0.5, 0.5}}));
  const Scene scene = coated(R"("clearcoatFactor": 0.1, "clearcoatRoughnessFactor": 0.3)");
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(roughness_of(scene.materials[0]), (PerceptualRoughness{{0.4, 0.4}, {0.5, 0.5}}));
  EXPECT_EQ(roughness_of(scene.materials[1]), (PerceptualRoughness{{0.3, 0.3}, none}));
  EXPECT_EQ(scene.materials[1].name, "car (clear coat)");
  const Scene textured = coated(R"("clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.3,
                                   "clearcoatRoughnessTexture": {"index": 0})");
  EXPECT_EQ(roughness_of(textured.materials.at(1)), (PerceptualRoughness{{0, 0.3}, none}));
  EXPECT_EQ(roughness_of(coated(R"("clearcoatFactor": 1)").materials.at(1)),
            (PerceptualRoughness{none, none}));
}

// ---- Unlit, and nothing at all ----

TEST(GltfExtensions, UnlitMaterialsNeedNothing) {
  const std::string unlit = R"({"extensions": {"KHR_materials_unlit": {}}})";
  EXPECT_EQ(only_material(load_materials(unlit + R"(, {"name": "lit"})")),
            (PerceptualRoughness{{1, 1}, none}));
  expect_refused("\"materials\": [" + unlit + "]", {"has no material", "not unlit"});
}

TEST(GltfExtensions, PrimitivesWithoutMaterialHaveTheDefaultOne) {
  const auto mesh = [](const std::string& primitive) {
    return "\"meshes\": [{\"primitives\": [" + primitive + "]}]";
  };
  const std::string smooth = R"("materials": [{"pbrMetallicRoughness": {"roughnessFactor": 0}}], )";
  for (const char* primitive :
       {R"({"attributes": {}})", R"({"mode": 5})", R"({"mode": 0, "attributes": {"NORMAL": 0}})",
        R"({"material": 1})", R"({"material": -1})"}) {
    const Scene scene = load_members(smooth + mesh(primitive));
    ASSERT_EQ(scene.materials.size(), 2u) << primitive;
    EXPECT_EQ(roughness_of(scene.materials[1]), (PerceptualRoughness{{1, 1}, none}));
    EXPECT_EQ(only_material(load_members(mesh(primitive))), (PerceptualRoughness{{1, 1}, none}));
  }
  // Points and lines without normals are not lit.
  for (const char* primitive : {R"({"material": 0})", R"({"mode": 0})",
                                R"({"mode": 3, "attributes": {"POSITION": 0}})", "3"})
    EXPECT_EQ(only_material(load_members(smooth + mesh(primitive))),
              (PerceptualRoughness{none, none}))
        << primitive;
  for (const char* meshes : {"3", "[]", "[3]", R"([{"primitives": 3}])"})
    expect_refused(fmt::format("\"meshes\": {}", meshes), {"has no material"});
}

// ---- Other packings of textures, and other lobes ----

TEST(GltfExtensions, PackedTexturesOfRoughnessCountAsTextures) {
  for (const char* extension :
       {R"("MSFT_packing_occlusionRoughnessMetallic": {"occlusionRoughnessMetallicTexture":)",
        R"("MSFT_packing_occlusionRoughnessMetallic": {"roughnessMetallicOcclusionTexture":)",
        R"("MSFT_packing_normalRoughnessMetallic": {"normalRoughnessMetallicTexture":)"})
    EXPECT_EQ(only_material(load_materials(
                  fmt::format(R"({{"pbrMetallicRoughness": {{"roughnessFactor": 0.5}},
                                   "extensions": {{{} {{"index": 1}}}}}}}})",
                              extension))),
              (PerceptualRoughness{{0, 0.5}, none}));
  EXPECT_EQ(only_material(load_materials(R"({"extensions": {
                "MSFT_packing_occlusionRoughnessMetallic": {"normalTexture": {"index": 1}}}})")),
            (PerceptualRoughness{{1, 1}, none}));
}

// Of each what has a say elsewhere, none of which is a GGX lobe of another roughness.
TEST(GltfExtensions, OthersLeaveTheLobesAsTheyAre) {
  const Scene scene = load_materials(R"({"pbrMetallicRoughness": {"roughnessFactor": 0.4},
    "emissiveFactor": [1, 1, 1],
    "extensions": {
      "KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1], "sheenRoughnessFactor": 0.7},
      "KHR_materials_transmission": {"transmissionFactor": 1},
      "KHR_materials_volume": {"thicknessFactor": 1}, "KHR_materials_ior": {"ior": 0},
      "KHR_materials_dispersion": {"dispersion": 1},
      "KHR_materials_iridescence": {"iridescenceFactor": 1},
      "KHR_materials_specular": {"specularFactor": 0},
      "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 1},
      "KHR_materials_emissive_strength": {"emissiveStrength": 5}, "MSFT_lod": {"ids": [0]}}})");
  EXPECT_EQ(only_material(scene), (PerceptualRoughness{{0.4, 0.4}, none}));
  EXPECT_EQ(scene.warnings, std::vector<std::string>{});
}

TEST(GltfExtensions, ThatNameARoughnessAndAreNotKnownAreWarnedOf) {
  const Scene scene = load_materials(R"({"extensions": {"EXT_materials_felt":
                                         {"feltRoughnessFactor": 0.3, "feltColor": 1}}})");
  ASSERT_EQ(scene.warnings.size(), 1u);
  test::expect_one_line(scene.warnings[0],
                        {"materials[0]", "\"feltRoughnessFactor\"", "\"EXT_materials_felt\""});
  for (const std::string used : {"KHR_interactivity", "NV_materials_mdl", "KHR_techniques_webgl"}) {
    const Scene other =
        load_members(R"("materials": [{}], "extensionsUsed": [3, ")" + used + "\"]");
    ASSERT_EQ(other.warnings.size(), 1u);
    test::expect_one_line(other.warnings[0], {used, "may change"});
  }
}

TEST(GltfExtensions, NumbersTooLargeInWhatIsNotReadAreWarnedOf) {
  const Scene scene = load_members(R"("cameras": [1e309, -1e400, "a \"1e309"],
      "materials": [{"name": "1e309", "emissiveFactor": [1.5e309, 1e-999]}])");
  EXPECT_EQ(only_material(scene), (PerceptualRoughness{{1, 1}, none}));
  EXPECT_EQ(scene.materials[0].name, "1e309");
  ASSERT_EQ(scene.warnings.size(), 1u);
  test::expect_one_line(scene.warnings[0], {"scene.gltf", "3 numbers too large"});
  expect_refused(R"("cameras": 1e309, "materials": [}])", {"not JSON"});
}

// ---- The files that the program was once found to read wrongly ----

TEST(GltfExtensions, FilesOfOthersReadAsTheyShould) {
  const auto folder = std::filesystem::path(LTCFIT_SOURCE_DIR) / "../shared/cases";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "no " << folder;
  const auto roughness = [&](const char* name, std::size_t warnings) {
    const Scene scene = load_scene(folder / name);
    EXPECT_EQ(scene.warnings.size(), warnings) << name;
    return only_material(scene).roughness;
  };
  EXPECT_EQ(roughness("specgloss.gltf", 0), (Interval{0, 0}));
  EXPECT_EQ(roughness("animated_roughness.gltf", 0), (Interval{0.1, 0.9}));
  EXPECT_EQ(roughness("no_material_mesh.gltf", 0), (Interval{1, 1}));
  EXPECT_EQ(roughness("infinite_number.gltf", 1), (Interval{0.5, 0.5}));
  EXPECT_EQ(roughness("trailing_byte.glb", 1), (Interval{0.5, 0.5}));
  test::expect_one_line(message_of<InputError>([&] { load_scene(folder / "unlit.gltf"); }),
                        {"has no material that looks anything up"});
}

}  // namespace
}  // namespace ltc
