// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// KTX 2.0 textures of 16- and 32-bit floats, plain or compressed with Zstandard: one image a file,
// or, written alone, one with its mip levels.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "export/image.h"

namespace ltc {

// The file's bytes; the same for the same image and version of the program. Compressed if asked
// for, unless it would shrink so far that our own reader took it for a bomb. Throws InputError for
// what cannot be stored: values, channels.
std::string encode_ktx2(const Image& image, bool zstd);

// The same of a flat image and its mip levels, each half as wide and high as the one before,
// rounded down, and at least one texel. Throws InputError for others.
std::string encode_ktx2(std::span<const Image> levels, bool zstd);

// The image that the bytes of `file` hold; it has no name. Throws InputError for anything else.
Image decode_ktx2(std::string_view bytes, const std::filesystem::path& file);

}  // namespace ltc
