// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Prefiltered textures of lights (render/light_texture.h) as files: four channels of 16 bits, all
// levels, row 0 the top one.
#pragma once

#include <filesystem>
#include <span>

#include "export/image.h"

namespace ltc {

// Whether the name ends as those of such files do: .ktx2, .exr.
bool is_light_texture_file(const std::filesystem::path& path);

// KTX 2.0 with mip levels (RGBA16F), compressed with Zstandard if asked for; or an OpenEXR image in
// mipmapped tiles. Whole or not at all, the same content as the same bytes. Throws InputError for
// another ending and for values above 65504, IoError where the system refuses.
void write_light_texture(std::span<const Image> levels, const std::filesystem::path& path,
                         bool zstd = true);

}  // namespace ltc
