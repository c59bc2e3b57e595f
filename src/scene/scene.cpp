// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "scene/scene.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/read_file.h"
#include "scene/readers.h"

namespace ltc {
namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// JSON begins with a brace, which no TOML does; the binary form with its magic word.
bool begins_as_gltf(const std::filesystem::path& file) {
  const std::string beginning = read_first_bytes(file, "scene", 4096);
  if (beginning.starts_with("glTF"))
    return true;
  const std::size_t first = beginning.find_first_not_of(" \t\r\n");
  return first != std::string::npos && beginning[first] == '{';
}

}  // namespace

LobeRoughness lobe_roughness(double roughness, double anisotropy) {
  const double alpha = roughness * roughness;
  // std::lerp is exact at both ends, and never below alpha: isotropic is lambda = 1 to the bit.
  return {std::lerp(alpha, 1.0, anisotropy * anisotropy), alpha};
}

Scene load_scene(const std::filesystem::path& file) {
  const std::string ending = lower_case(file.extension().string());
  const bool gltf = ending == ".gltf" || ending == ".glb";
  if (gltf || (ending != ".toml" && begins_as_gltf(file)))
    return load_gltf_scene(file);
  return load_toml_scene(file);
}

}  // namespace ltc
