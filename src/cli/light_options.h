// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The light of a picture as options name it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/files.h"
#include "core/run_context.h"
#include "render/sphere_scene.h"

namespace ltc::cli {

struct LightArguments {
  std::string kind = "rectangle";  // a shape, or the file of an image on a rectangle
  std::string position;            // "X,Y,Z"; empty: the usual one
  double size = 1;                 // times that of figure 14
  bool two_sided = false;

  bool has_image() const;
  Eigen::Vector3d center(ObjectShape shape) const;
  // "a rectangular light", "a star".
  std::string text() const;
};

void add_light_options(CLI::App& app, LightArguments& arguments, const char* group);

// Reads and prefilters its image, if it has one.
Light light_of(const LightArguments& arguments, ObjectShape shape, const RunContext& run);

}  // namespace ltc::cli
