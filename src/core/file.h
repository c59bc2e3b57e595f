// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What readers and writers of files share: whether a file can be read, one-line messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace ltc {

// The size in bytes of a regular file that can be read. Throws IoError naming the path and the
// reason for one that is missing, a folder, or not readable.
std::uintmax_t require_readable(const std::filesystem::path& path);

// Throws InputError: "FILE: what is wrong with it".
[[noreturn]] void refuse_file(const std::filesystem::path& file, const std::string& what);

// The same text with line breaks as spaces: messages of other libraries run over several lines.
std::string on_one_line(std::string text);

}  // namespace ltc
