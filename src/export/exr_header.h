// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A guard before the OpenEXR library, which takes memory for an attribute before it looks whether
// the file has that many bytes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace ltc {

// What is wrong with the header of an image (a row of attributes: name, type, size, value; OpenEXR
// File Layout); empty if nothing is. It must be of a single-part scan-line image, end within the
// file, and give every value the size that its type has, for the library goes by the type. Files
// that do not begin as OpenEXR does are left to the library to refuse.
std::string exr_header_fault(const std::filesystem::path& path);

// While one of these lives, no header can make the library take memory for an image with a larger
// side.
class BoundedExrSize {
 public:
  explicit BoundedExrSize(std::size_t largest_side);
  ~BoundedExrSize();
  BoundedExrSize(const BoundedExrSize&) = delete;
  BoundedExrSize& operator=(const BoundedExrSize&) = delete;
};

}  // namespace ltc
