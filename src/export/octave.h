// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltc_code's ltc.mat, in Octave's text: matrices tab00, tab10, ... and tabMagnitude of one number a
// node, a line a theta; the names have the column and the row of M.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "export/image.h"

namespace ltc {

// One image of nine channels, M column by column, and one of the amplitudes if they are there;
// other matrices are passed over. Throws InputError for anything else.
std::vector<Image> decode_octave(std::string_view text, const std::filesystem::path& file);

}  // namespace ltc
