// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Images that lights emit, read from PNG and OpenEXR.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace ltc {

// Linear red, green, blue and alpha, row by row from the top, each row from the left. Alpha is kept
// apart: the colours are not multiplied by it. A texel is a square of one colour.
struct LightImage {
  std::size_t width = 0, height = 0;
  std::vector<float> rgba;  // 4 * width * height of them, finite and not negative

  const float* texel(std::size_t row, std::size_t column) const {
    return &rgba[4 * (row * width + column)];
  }
};

inline constexpr std::size_t largest_light_image_side = 4096;

// By its content: PNG of any kind, 8 or 16 bits, which is taken as sRGB whatever its chunks say, or
// OpenEXR, single-part scan lines with the channels R, G, B or Y, linear. Alpha is 1 where there is
// none. Throws IoError for a file that cannot be read; InputError for one that is no image, is
// damaged, has no pixels or a side above 4096, and for values that are negative or not finite.
LightImage read_light_image(const std::filesystem::path& path);

}  // namespace ltc
