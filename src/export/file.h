// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What every reader and writer of a table file needs: opening, writing whole, one-line messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace ltc {

// The size in bytes of a regular file that can be read. Throws IoError naming the path and the
// reason for one that is missing, a folder, or not readable.
std::uintmax_t require_readable(const std::filesystem::path& path);

// Writes `bytes` to `path`, whole or not at all (platform::write_atomically). Throws IoError.
void write_file(const std::filesystem::path& path, std::string_view bytes);

// The same text with line breaks as spaces: messages of other libraries run over several lines.
std::string on_one_line(std::string text);

}  // namespace ltc
