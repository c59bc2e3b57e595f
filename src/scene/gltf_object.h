// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// An object within a glTF material: its numbers and textures, and what animations make of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf_animation.h"

namespace ltc {

// What all objects of a file share. References only.
struct GltfContext {
  const GltfAnimations& animations;
  std::vector<std::string>& warnings;
};

class GltfObject {
 public:
  // `label` is how messages name it, `pointer` how animations do ("/materials/0").
  GltfObject(const GltfContext& context, std::string label, std::string pointer,
             const nlohmann::json& value)
      : context_(context), label_(std::move(label)), pointer_(std::move(pointer)), value_(value) {}

  bool has(std::string_view key) const { return member_of(&value_, key) != nullptr; }

  // An object of this one; an empty one if the key is not there. Throws InputError for another
  // value, as all below.
  GltfObject object(std::string_view key) const;

  // A number in [0, 1] and all that animations make of it.
  Interval factor(std::string_view key, double otherwise) const;

  // Whether there is a texture; what it shows is not looked at.
  bool has_texture(std::string_view key) const;

  // A texture multiplies its factor by anything in [0, 1].
  Interval textured_factor(std::string_view key, double otherwise, std::string_view texture) const;

 private:
  [[noreturn]] void refuse(std::string_view key, const nlohmann::json& value,
                           std::string_view expected) const;

  GltfContext context_;
  std::string label_, pointer_;
  const nlohmann::json& value_;
};

}  // namespace ltc
