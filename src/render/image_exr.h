// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Images as layers of an OpenEXR file.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "picture/canvas.h"

namespace ltc {

struct ImageLayer {
  std::string channel;  // "ggx.Y": layer and channel
  const picture::Field* image;
};
struct ImageAttribute {
  std::string name, text;
};

// Writes the images, all of one size, in 32 bits; whole or not at all, the same content as the same
// bytes. Throws InputError for images of different sizes or none, IoError where the system refuses.
void write_image_exr(std::span<const ImageLayer> layers, std::span<const ImageAttribute> attributes,
                     const std::filesystem::path& path);

}  // namespace ltc
