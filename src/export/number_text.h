// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Images as lists of numbers in text: JSON, JavaScript, C. Every number is the shortest that reads
// back as the same float; those of an image of halves are halves.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "export/image.h"

namespace ltc {

// {"size": {"LTC_MAT_1": [width, height, layers, channels]}, "LTC_MAT_1": [...], ...}
std::string encode_json(const std::vector<Image>& images);

// A module: export const LTC_MAT_1 = [...]; or another declaration of the arrays.
std::string encode_javascript(const std::vector<Image>& images,
                              std::string_view declaration = "export const");

// static const float ltc_1[16384] = {...}; between the lines of an include guard.
std::string encode_c_header(const std::vector<Image>& images, std::string_view guard_name);

// Unity's table as a part of its class LTCAreaLight: the bits of halves,
// internal static ushort[] s_LtcMatrixData_BRDF_GGX = new ushort[64 * 64 * 4] {...};
std::string encode_c_sharp(const std::vector<Image>& images);

// All throw InputError for no images, for names that the language does not allow or that
// stand twice, and for values that are not finite or beyond the precision.

// The readers below give images of single precision, flat or, of several layers, arrays. A file
// that says nothing of sizes, which are others' files, has square images of 4 channels. They throw
// InputError for anything else, for counts that are not those of the size, and for numbers that are
// not finite.

// An object of named lists of numbers, as encode_json makes it or without its "size".
std::vector<Image> decode_json(std::string_view text, const std::filesystem::path& file);

// The lists of numbers in JavaScript, C or C#: NAME = [...], NAME[16384] = {...} or NAME = new
// double[...] {...}, where "ushort" is the bits of halves. Lists of lists are read as
// [rows][columns] [channels] or [texels of a square][channels], if these are even; whatever else
// the file has is passed over.
std::vector<Image> decode_number_lists(std::string_view text, const std::filesystem::path& file);

}  // namespace ltc
