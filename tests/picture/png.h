// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Reads PNG files with libpng, to check those that Cairo wrote.
#pragma once

#include <string>
#include <vector>

namespace ltc::picture::test {

struct DecodedPng {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  // three bytes a pixel, row by row from the top
};

// Throws std::runtime_error if the bytes are no complete PNG.
DecodedPng decode_png(const std::string& bytes);

}  // namespace ltc::picture::test
