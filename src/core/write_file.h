// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Writing output files whole or not at all.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "core/platform.h"

namespace ltc {

// Writes `bytes` to `path`; where that fails an older file stands as it was. Throws IoError naming
// the path and the reason.
void write_file(const std::filesystem::path& path, std::string_view bytes);

// The same as one of several files, which all take their places with files.commit().
void add_file(platform::FileSet& files, const std::filesystem::path& path, std::string_view bytes);
// Parts one after the other.
void add_file(platform::FileSet& files, const std::filesystem::path& path,
              std::span<const std::string_view> parts);

}  // namespace ltc
