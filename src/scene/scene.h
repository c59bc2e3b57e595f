// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a scene asks of a table: the roughnesses of its materials and the angles they are seen from.
#pragma once

#include <filesystem>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "brdf/ggx.h"

namespace ltc {

// All values from low to high, both included; low <= high.
struct Interval {
  double low = 0;
  double high = 0;
  bool operator==(const Interval&) const = default;
};

// Any alpha_x of the first with any alpha_y of the second, each within [0, 1].
struct RoughnessBox {
  Interval alpha_x, alpha_y;
  bool operator==(const RoughnessBox&) const = default;
};

// Any perceptual roughness of the first with any anisotropy of the second, each within [0, 1]; the
// lobes are those of lobe_roughness.
struct PerceptualRoughness {
  Interval roughness, anisotropy;
  bool operator==(const PerceptualRoughness&) const = default;
};

struct Material {
  std::string name;  // may be empty
  std::variant<RoughnessBox, PerceptualRoughness> roughness;
  Interval theta_radians{0, std::numbers::pi / 2};  // between view direction and normal
  bool operator==(const Material&) const = default;
};

struct Scene {
  std::vector<Material> materials;         // at least one
  std::vector<std::string> warnings = {};  // what a user should know of the file, a line each
};

// The mapping of glTF's KHR_materials_anisotropy: with alpha = roughness^2, along the tangent
// alpha_t = mix(alpha, 1, anisotropy^2), across it alpha_b = alpha. Both arguments in [0, 1].
// alpha_t is alpha_x here; which of the two axes it is makes no difference to the entries that a
// table needs, since look-ups fold the one into the other (equation 14 of Aakash et al. 2022). The
// larger, alpha_t, is exactly alpha where anisotropy is 0 and exactly 1 where it is 1.
struct LobeRoughness {
  double alpha_x, alpha_y;
};
LobeRoughness lobe_roughness(double roughness, double anisotropy);

// Reads a scene: TOML (docs/scenes.md), glTF 2.0 as .gltf or .glb. The name's ending says which; of
// a file with another ending, its first characters. Throws IoError if the file cannot be read,
// InputError for what it says: one line with the file, the material, the key, the value and what is
// allowed.
Scene load_scene(const std::filesystem::path& file);

}  // namespace ltc
