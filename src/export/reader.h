// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables from a file of any format that the program writes.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "table/table.h"

namespace ltc {

// By suffix: .h5, .npy, or one of the three textures <name>.0.exr to <name>.2.exr, which brings in
// the other two. `layout` is for files without axes, .npy (see read_npy); others say what they
// hold. Throws InputError for another suffix, and as the format's own reader.
Table read_table(const std::filesystem::path& path, std::optional<Layout> layout = std::nullopt);

// All files that read_table reads for this one: the three textures, or the file alone.
std::vector<std::filesystem::path> files_of_table(const std::filesystem::path& path);

// What a file of such a name holds beside axes and matrices.
struct TableContents {
  bool albedo = true;  // amplitude and Fresnel: not in an .npy
  bool loss = true;    // and what else is known of the fits: in an .h5 alone
};
TableContents contents_of(const std::filesystem::path& path);

}  // namespace ltc
