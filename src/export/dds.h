// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// DirectDraw Surfaces of 16- and 32-bit floats, without further mip levels: one image a file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "export/image.h"

namespace ltc {

enum class DdsHeader {
  dx10,    // 148 bytes; names a DXGI format
  legacy,  // 128 bytes; a number of D3D9's as FourCC, as ltc_code's files have; no arrays
};

// The file's bytes. Throws InputError for what cannot be stored: values, channels, shape.
std::string encode_dds(const Image& image, DdsHeader header = DdsHeader::dx10);

// The image that the bytes of `file` hold, with either header; it has no name, and an array of one
// layer is flat. Throws InputError for anything else.
Image decode_dds(std::string_view bytes, const std::filesystem::path& file);

}  // namespace ltc
