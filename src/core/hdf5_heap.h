// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A guard before the HDF5 library, which trusts the one structure of a file without a checksum.
#pragma once

#include <filesystem>

namespace ltc {

// Whether every global heap collection of the file, where texts of variable length lie (HDF5 File
// Format Specification 3.0, III.E), can be walked from its first object to its end. The library
// walks them without looking at the sizes it meets: a single wrong bit makes it loop or read beyond
// its memory. False, too, if the file cannot be read.
bool global_heaps_are_sound(const std::filesystem::path& path);

}  // namespace ltc
