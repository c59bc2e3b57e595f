// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Images one after another as bare little-endian floats or halves, described by a JSON beside them:
// {"images": [{"name", "shape", "width", "height", "layers", "channels", "precision"}, ...]}.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "export/image.h"

namespace ltc {

// The bytes, and what describes them. Throw InputError for no images and for what cannot be stored.
std::string encode_raw(const std::vector<Image>& images);
std::string describe_raw(const std::vector<Image>& images);

// The images of the bytes of `file`, which are exactly those that the description asks for; the
// description is the text of `description_file`. Throws InputError for anything else.
std::vector<Image> decode_raw(std::string_view bytes, std::string_view description,
                              const std::filesystem::path& file,
                              const std::filesystem::path& description_file);

// Those of engines, which have no description, told by their length: PlayCanvas' two images of
// four floats after the numbers 0 and 1 of 16 bits, and Babylon's one of eight halfs; square ones.
// Throws InputError for anything else.
std::vector<Image> decode_bare(std::string_view bytes, const std::filesystem::path& file);

}  // namespace ltc
