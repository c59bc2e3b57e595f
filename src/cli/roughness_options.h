// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The roughness of a lobe on the command line: alpha along x and y, as tables have it, or roughness
// and anisotropy, as editors do.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "scene/scene.h"

namespace ltc::cli {

struct RoughnessArguments {
  std::optional<double> alpha_x, alpha_y;
  std::optional<double> roughness, anisotropy;

  bool any() const { return alpha_x || alpha_y || roughness || anisotropy; }
};

// What x and y are to the command.
struct RoughnessHelp {
  const char* x;
  const char* y;
  const char* group;
};
void add_roughness_options(CLI::App& app, RoughnessArguments& arguments, const RoughnessHelp& help);

// By lobe_roughness where it is named as editors do. Throws InputError where one of a pair is
// missing, both kinds are given, or an alpha is not in [least_alpha, 1].
LobeRoughness roughness_of(const RoughnessArguments& arguments, double least_alpha);

// "0.3,0.05", or "roughness=0.3,anisotropy=0.5", of which the second may be left out. Throws
// InputError that begins with `option`.
LobeRoughness parse_roughness(const std::string& option, const std::string& text,
                              double least_alpha);

}  // namespace ltc::cli
