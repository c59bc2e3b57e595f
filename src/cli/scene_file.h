// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The scene that a command is given.
#pragma once

#include <filesystem>

#include "scene/scene.h"

namespace ltc::cli {

// load_scene, its warnings told on standard error, a line each.
Scene load_scene_and_warn(const std::filesystem::path& file);

}  // namespace ltc::cli
