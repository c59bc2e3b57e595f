// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The readers behind load_scene, one for each format.
#pragma once

#include <filesystem>

#include "scene/scene.h"

namespace ltc {

// [[material]] tables; see docs/scenes.md.
Scene load_toml_scene(const std::filesystem::path& file);

// The materials of a glTF 2.0 file: JSON, or the JSON chunk of the binary form, either of at most
// 256 MiB. No image is opened, and of buffers only what animations of roughness need. A texture on
// a factor means all values from 0 to the factor.
Scene load_gltf_scene(const std::filesystem::path& file);

}  // namespace ltc
