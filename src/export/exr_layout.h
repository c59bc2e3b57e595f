// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How a table's values lie in the three images, four of folded lobes: shared by exr_write.cpp and
// exr_read.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "export/entry_channels.h"
#include "export/format.h"

namespace ltc {

// Every entry counts as fitted, its loss is NaN, its steps 0, precision `half` where a channel is;
// seed, config, generator and created are empty, the BRDF is taken to be GGX.
Table read_exr(const TableFiles& files, const ReadAs& as);

namespace exr_layout {

inline constexpr int version = 1;                                // of ltc:format_version
inline constexpr std::size_t most_files = texels_per_entry + 1;  // of folded lobes
inline constexpr std::size_t channels_per_file = channels_per_texel;
inline constexpr std::array<const char*, channels_per_file> channel_names = {"R", "G", "B", "A"};

// What R, G, B and A of each file hold, as in the attribute ltc:channels.
inline constexpr std::array<std::string_view, most_files> channel_contents = {
    "m00,m01,m02,m10", "m11,m12,m20,m21", "m22,amplitude,fresnel,0", "kappa,gamma,0,0"};

inline const std::vector<std::string> endings = {".0.exr", ".1.exr", ".2.exr"};
inline const std::vector<std::string> folded_endings = {".0.exr", ".1.exr", ".2.exr", ".3.exr"};

struct Size {
  std::size_t width, height;
};
inline Size atlas_size(const Grid& grid) {
  return {grid.phi.size() * grid.lambda.size(), grid.theta.size() * grid.alpha.size()};
}

// Index of an entry's pixel, row by row.
inline std::size_t pixel(const Grid& grid, std::size_t flat) {
  const NodeIndex node = grid.node(flat);
  const std::size_t x = node.phi + grid.phi.size() * node.lambda;
  const std::size_t y = node.theta + grid.theta.size() * node.alpha;
  return y * atlas_size(grid).width + x;
}

}  // namespace exr_layout

}  // namespace ltc
