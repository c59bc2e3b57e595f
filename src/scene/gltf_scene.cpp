// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The roughness of glTF 2.0 materials: pbrMetallicRoughness and KHR_materials_anisotropy.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "scene/gltf_file.h"
#include "scene/readers.h"

namespace ltc {
namespace {

using nlohmann::json;

// One object of a material, and how to name it in messages.
class GltfObject {
 public:
  GltfObject(std::string label, const json& value) : label_(std::move(label)), value_(value) {}

  [[noreturn]] void refuse(std::string_view key, const json& value,
                           std::string_view expected) const {
    throw InputError(
        fmt::format("{}{} = {}: expected {}", label_, key, short_text(value), expected));
  }

  const json* find(std::string_view key) const {
    const auto member = value_.find(key);
    return member == value_.end() ? nullptr : &*member;
  }

  // An object of this one; an empty one if the key is not there.
  GltfObject object(std::string_view key) const {
    static const json empty = json::object();
    const json* member = find(key);
    if (member && !member->is_object())
      refuse(key, *member, "an object");
    return {fmt::format("{}{}.", label_, key), member ? *member : empty};
  }

  double factor(std::string_view key, double otherwise) const {
    const json* member = find(key);
    if (!member)
      return otherwise;
    if (!member->is_number() || !(member->get<double>() >= 0 && member->get<double>() <= 1))
      refuse(key, *member, "a number in [0, 1]");
    return member->get<double>();
  }

  // Whether there is a texture; what it shows is not looked at.
  bool has_texture(std::string_view key) const {
    if (!find(key))
      return false;
    const GltfObject texture = object(key);
    const json* index = texture.find("index");
    if (!index || !index->is_number_unsigned())
      texture.refuse("index", index ? *index : json(), "the number of a texture");
    return true;
  }

  // A texture multiplies its factor by anything in [0, 1].
  Interval textured_factor(std::string_view key, double otherwise, std::string_view texture) const {
    const double most = factor(key, otherwise);
    return {has_texture(texture) ? 0 : most, most};
  }

 private:
  std::string label_;
  const json& value_;
};

Material read_material(const std::filesystem::path& file, const json& value, std::size_t index) {
  std::string label = fmt::format("{}: materials[{}]", file.string(), index);
  if (!value.is_object())
    throw InputError(fmt::format("{} = {}: expected an object", label, short_text(value)));
  Material material;
  if (const auto name = value.find("name"); name != value.end()) {
    if (!name->is_string())
      throw InputError(fmt::format("{}: name = {}: expected a string", label, short_text(*name)));
    material.name = name->get<std::string>();
    label = fmt::format("{} {}", label, short_text(*name));
  }
  const GltfObject root(fmt::format("{}: ", label), value);
  const GltfObject metallic_roughness = root.object("pbrMetallicRoughness");
  const GltfObject anisotropy = root.object("extensions").object("KHR_materials_anisotropy");
  material.roughness = PerceptualRoughness{
      metallic_roughness.textured_factor("roughnessFactor", 1, "metallicRoughnessTexture"),
      anisotropy.textured_factor("anisotropyStrength", 0, "anisotropyTexture")};
  return material;
}

}  // namespace

Scene load_gltf_scene(const std::filesystem::path& file) {
  const json root = read_gltf(file);
  const auto materials = root.find("materials");
  if (materials != root.end() && !materials->is_array())
    throw InputError(fmt::format("{}: materials = {}: expected an array", file.string(),
                                 short_text(*materials)));
  if (materials == root.end() || materials->empty())
    throw InputError(
        fmt::format("{}: has no material; expected at least one in \"materials\"", file.string()));
  Scene scene;
  for (const json& material : *materials)
    scene.materials.push_back(read_material(file, material, scene.materials.size()));
  return scene;
}

}  // namespace ltc
