// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// KTX 2.0 textures of 16- and 32-bit floats, one mip level, plain or compressed with Zstandard: one
// image a file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "export/image.h"

namespace ltc {

// The file's bytes; the same for the same image and version of the program. Compressed if asked
// for, unless it would shrink so far that our own reader took it for a bomb. Throws InputError for
// what cannot be stored: values, channels.
std::string encode_ktx2(const Image& image, bool zstd);

// The image that the bytes of `file` hold; it has no name. Throws InputError for anything else.
Image decode_ktx2(std::string_view bytes, const std::filesystem::path& file);

}  // namespace ltc
