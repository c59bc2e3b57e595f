// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// An image of numbers as engines take it: what the containers of textures hold (dds.h, ktx2.h,
// number_text.h, raw_image.h), whatever it means.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "table/precision.h"

namespace ltc {

enum class ImageShape {
  flat,    // one layer
  array,   // layers, which are not interpolated between
  volume,  // slices of a 3-D texture
};

// Values lie layer by layer (slice by slice), row by row, texel by texel, channel by channel.
struct Image {
  std::string name;  // where the container has names: "ltc_1"
  ImageShape shape = ImageShape::flat;
  std::size_t width = 0, height = 0;
  std::size_t layers = 1;    // or slices
  std::size_t channels = 4;  // 1 to 9; textures have 1 to 4
  Precision precision = Precision::single;
  std::vector<float> values;

  std::size_t texels() const { return width * height * layers; }
  bool operator==(const Image&) const = default;
};

// Larger images are refused before memory is taken for them: the largest table as one texture.
inline constexpr std::size_t max_image_side = 16384;
inline constexpr std::size_t most_channels = 9;  // a whole matrix
inline constexpr std::size_t max_image_values = std::size_t{3} << 26;

}  // namespace ltc
