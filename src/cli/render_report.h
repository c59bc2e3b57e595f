// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What render tells of the spheres: text and JSON.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "render/sphere_picture.h"

namespace ltc::cli {

struct RenderReport {
  std::vector<std::string> files, names;  // of the tables; what the pictures call them
  std::string shape, light;               // "sphere"; a light's shape, or the file of its image
  Eigen::Vector3d light_position;
  double light_size = 1;  // times that of figure 14
  bool two_sided = false;
  std::size_t samples = 0, size = 0;
  std::string_view horizon;       // "clipped", "scaled"
  std::string reference = "GGX";  // what is sampled, LobeModel::label
  // One a material.
  std::vector<SphereRow> rows;
  std::vector<double> seconds;
  std::vector<std::filesystem::path> images;
  std::filesystem::path picture;
};

// "Table: out/ltc.h5", or "A: out/ltc.h5, B: other.npy".
std::string tables_text(const RenderReport& report);

// A line a material and table that is clamped: "0.8, 0.4 is beyond the axes of out/ltc.h5, clamped:
// alpha 0.8 to 0.6". Empty where none is.
std::string clamping_warnings(const RenderReport& report);

std::string report_text(const RenderReport& report);
std::string report_json(const RenderReport& report);  // with a line break at its end

}  // namespace ltc::cli
