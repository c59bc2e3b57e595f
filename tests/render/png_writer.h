// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// PNG files of any kind, for the tests that read them.
#pragma once

#include <png.h>

#include <cmath>
#include <cstddef>
#include <string>

namespace ltc::testing {

// `color_type` is PNG's; rows of samples of 8 or 16 bits, big-endian as PNG has them.
inline std::string png_bytes(unsigned width, unsigned height, int bit_depth, int color_type,
                             std::string samples) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp to, png_bytep data, std::size_t count) {
        static_cast<std::string*>(png_get_io_ptr(to))
            ->append(reinterpret_cast<const char*>(data), count);
      },
      nullptr);
  png_set_IHDR(png, info, width, height, bit_depth, color_type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  const std::size_t row_bytes = samples.size() / height;
  for (unsigned row = 0; row < height; ++row)
    png_write_row(png, reinterpret_cast<png_bytep>(samples.data() + row * row_bytes));
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

// A picture that a light shows in tests: a few bright shapes on a dark ground, in colours.
inline std::string window_png(unsigned side = 64) {
  std::string samples;
  for (unsigned row = 0; row < side; ++row)
    for (unsigned column = 0; column < side; ++column) {
      const double x = (column + 0.5) / side, y = (row + 0.5) / side;
      const bool bar = std::abs(x - 0.5) < 0.04 || std::abs(y - 0.5) < 0.04;
      const bool warm = x < 0.5, high = y < 0.5;
      const int level = bar ? 20 : warm != high ? 255 : 120;
      samples += static_cast<char>(level);
      samples += static_cast<char>(warm ? level * 3 / 4 : level);
      samples += static_cast<char>(high ? level : level / 2);
    }
  return png_bytes(side, side, 8, PNG_COLOR_TYPE_RGB, samples);
}

}  // namespace ltc::testing
