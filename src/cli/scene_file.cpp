// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/scene_file.h"

#include <fmt/format.h>

#include <cstdio>

#include "cli/output.h"

namespace ltc::cli {

Scene load_scene_and_warn(const std::filesystem::path& file) {
  Scene scene = load_scene(file);
  for (const std::string& warning : scene.warnings)
    std::fputs(fmt::format("ltcfit: warning: {}\n", one_line(warning)).c_str(), stderr);
  return scene;
}

}  // namespace ltc::cli
