// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How far the animations of a glTF file move the numbers of its materials (KHR_animation_pointer).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf_file.h"
#include "scene/scene.h"

namespace ltc {

// Looks up animations by the JSON pointer of what they move.
class GltfAnimations {
 public:
  // Keeps a reference to `file`.
  explicit GltfAnimations(const GltfFile& file);

  // All values within [0, 1] that animations give to the number at `pointer`; nothing if they leave
  // it alone. Everything, with a warning, where the file does not tell: spline curves, which pass
  // their values, and accessors with neither min and max nor values that can be read.
  std::optional<Interval> range_of(const std::string& pointer,
                                   std::vector<std::string>& warnings) const;

 private:
  const GltfFile& file_;
  std::multimap<std::string, const nlohmann::json*> samplers_;  // null where there is none
  mutable std::uint64_t bytes_left_ = std::uint64_t{1} << 30;   // to be read in buffers
};

// The least range that holds all values of an accessor of single numbers: by its min and max, else
// by its values where they can be read. Nothing if the file does not tell, or not within
// `bytes_left`, from which what is read is taken: accessors may share their bytes, and a small file
// ask for many times what it holds.
std::optional<Interval> accessor_range(const GltfFile& file, std::optional<std::uint64_t> accessor,
                                       std::uint64_t& bytes_left);

}  // namespace ltc
