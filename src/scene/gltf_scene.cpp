// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The GGX lobes of glTF 2.0 materials: the base, by either workflow and with its anisotropy, and
// the clear coat. docs/scenes.md says what is done for which extension.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/error.h"
#include "scene/gltf_object.h"
#include "scene/readers.h"

namespace ltc {
namespace {

using nlohmann::json;

// ---- Roughness ----

// Glossiness is the other end of roughness; a texture multiplies it by anything in [0, 1].
Interval roughness_of_glossiness(const GltfObject& specular_glossiness) {
  const Interval glossiness =
      specular_glossiness.textured_factor("glossinessFactor", 1, "specularGlossinessTexture");
  return {1 - glossiness.high, 1 - glossiness.low};
}

// Textures of other packings stand in for that of the format.
bool has_packed_roughness(const GltfObject& extensions) {
  const GltfObject occlusion = extensions.object("MSFT_packing_occlusionRoughnessMetallic");
  const GltfObject normal = extensions.object("MSFT_packing_normalRoughnessMetallic");
  return occlusion.has_texture("occlusionRoughnessMetallicTexture") ||
         occlusion.has_texture("roughnessMetallicOcclusionTexture") ||
         normal.has_texture("normalRoughnessMetallicTexture");
}

Interval base_roughness(const GltfObject& material, const GltfObject& extensions) {
  Interval roughness = material.object("pbrMetallicRoughness")
                           .textured_factor("roughnessFactor", 1, "metallicRoughnessTexture");
  if (has_packed_roughness(extensions))
    roughness.low = 0;
  // Who knows the extension takes it instead.
  static constexpr std::string_view other = "KHR_materials_pbrSpecularGlossiness";
  return extensions.has(other) ? roughness_of_glossiness(extensions.object(other)) : roughness;
}

// ---- What is not followed ----

bool names_a_roughness(std::string key) {
  std::transform(key.begin(), key.end(), key.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return key.find("rough") != std::string::npos || key.find("gloss") != std::string::npos ||
         key.find("anisotrop") != std::string::npos;
}

// Of these it is known what they do to a lobe of the table.
constexpr std::array<std::string_view, 6> followed_extensions = {
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "MSFT_packing_normalRoughnessMetallic",
    "MSFT_packing_occlusionRoughnessMetallic"};

template <typename Names>
bool contains(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void warn_of_unknown_lobes(const std::string& label, const json& material,
                           std::vector<std::string>& warnings) {
  const json* const extensions = member_of(&material, "extensions");
  if (!extensions)
    return;
  for (const auto& extension : extensions->items())
    if (extension.value().is_object() && !contains(followed_extensions, extension.key()))
      for (const auto& member : extension.value().items())
        if (names_a_roughness(member.key()))
          warnings.push_back(fmt::format("{}: {} of the extension {} is not known and not counted",
                                         label, short_text(json(member.key())),
                                         short_text(json(extension.key()))));
}

void warn_of_unknown_changes(const GltfFile& file, std::vector<std::string>& warnings) {
  static constexpr std::array<std::string_view, 3> changing = {
      "KHR_interactivity", "KHR_techniques_webgl", "NV_materials_mdl"};
  const json* const used = member_of(&file.root, "extensionsUsed");
  if (!used || !used->is_array())
    return;
  for (const std::string_view name : changing)
    if (contains(*used, name))
      warnings.push_back(
          fmt::format("{}: {} may change the materials' roughness, which is not looked at",
                      file.path.string(), name));
}

// ---- Materials ----

class MaterialsReader {
 public:
  MaterialsReader(const GltfFile& file, Scene& scene)
      : file_(file), animations_(file), scene_(scene) {}

  // All of them, whether something has them or not: variants and levels of detail may ask for any.
  void read_materials() {
    const json* const materials = member_of(&file_.root, "materials");
    if (!materials)
      return;
    if (!materials->is_array())
      throw InputError(fmt::format("{}: materials = {}: expected an array", file_.path.string(),
                                   short_text(*materials)));
    for (std::size_t index = 0; index < materials->size(); ++index)
      read_material((*materials)[index], index);
    material_count_ = materials->size();
  }

  // What the format gives to primitives without a material.
  void read_default_material() {
    const json* const meshes = member_of(&file_.root, "meshes");
    if (meshes && meshes->is_array() &&
        std::any_of(meshes->begin(), meshes->end(), [&](const json& mesh) {
          const json* const primitives = member_of(&mesh, "primitives");
          return primitives && primitives->is_array() &&
                 std::any_of(primitives->begin(), primitives->end(),
                             [&](const json& primitive) { return takes_default(primitive); });
        }))
      add("(default material)", {1, 1}, {0, 0});
  }

 private:
  void add(const std::string& name, const Interval& roughness, const Interval& anisotropy) {
    Material material;
    material.name = name;
    material.roughness = PerceptualRoughness{roughness, anisotropy};
    scene_.materials.push_back(material);
  }

  void read_material(const json& value, std::size_t index) {
    std::string label = fmt::format("{}: materials[{}]", file_.path.string(), index);
    if (!value.is_object())
      throw InputError(fmt::format("{} = {}: expected an object", label, short_text(value)));
    std::string name;
    if (const json* const member = member_of(&value, "name")) {
      if (!member->is_string())
        throw InputError(
            fmt::format("{}: name = {}: expected a string", label, short_text(*member)));
      name = member->get<std::string>();
      label = fmt::format("{} {}", label, short_text(*member));
    }
    const GltfObject material({animations_, scene_.warnings}, label + ": ",
                              fmt::format("/materials/{}", index), value);
    const GltfObject extensions = material.object("extensions");
    if (extensions.has("KHR_materials_unlit"))
      return;
    add(name, base_roughness(material, extensions),
        extensions.object("KHR_materials_anisotropy")
            .textured_factor("anisotropyStrength", 0, "anisotropyTexture"));
    add_clear_coat(name, extensions.object("KHR_materials_clearcoat"));
    warn_of_unknown_lobes(label, value, scene_.warnings);
  }

  // An isotropic lobe on top of the others.
  void add_clear_coat(const std::string& name, const GltfObject& coat) {
    const Interval roughness =
        coat.textured_factor("clearcoatRoughnessFactor", 0, "clearcoatRoughnessTexture");
    if (coat.factor("clearcoatFactor", 0).high > 0)
      add(name + " (clear coat)", roughness, {0, 0});
  }

  bool takes_default(const json& primitive) const {
    constexpr std::uint64_t triangles = 4;  // and its strips and fans; below it, points and lines
    const json* const mode = member_of(&primitive, "mode");
    // Points and lines without normals are not lit.
    const bool lit = !mode || whole_number(mode).value_or(triangles) >= triangles ||
                     member_of(member_of(&primitive, "attributes"), "NORMAL");
    const json* const material = member_of(&primitive, "material");
    return primitive.is_object() && lit &&
           (!material || whole_number(material).value_or(material_count_) >= material_count_);
  }

  const GltfFile& file_;
  const GltfAnimations animations_;
  Scene& scene_;
  std::size_t material_count_ = 0;
};

}  // namespace

Scene load_gltf_scene(const std::filesystem::path& path) {
  const GltfFile file = read_gltf(path);
  Scene scene;
  scene.warnings = file.warnings;
  MaterialsReader reader(file, scene);
  reader.read_materials();
  reader.read_default_material();
  warn_of_unknown_changes(file, scene.warnings);
  if (scene.materials.empty())
    throw InputError(
        fmt::format("{}: has no material that looks anything up; expected at least one in "
                    "\"materials\" that is "
                    "not unlit, or a mesh without one",
                    path.string()));
  return scene;
}

}  // namespace ltc
