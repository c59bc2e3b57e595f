// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A glTF 2.0 file, text or binary: its JSON without what says nothing about materials, and bytes of
// its buffers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ltc {

struct GltfFile {
  std::filesystem::path path;
  nlohmann::json root;                // without the members that nobody asks for
  std::uint64_t binary_begin = 0;     // of a binary file, where its second chunk begins
  std::uint64_t binary_bytes = 0;     // and how long it is; 0 where there is none
  std::vector<std::string> warnings;  // what was overlooked to read it
};

// The file, whose asset.version is 2.x. A number too large for a double is a text that says so, and
// bytes after the end of a binary file are left out; both with a warning. Throws IoError if the
// file cannot be read; InputError if it is no such file: not JSON or not UTF-8, nested deeper than
// 64 levels, more than 256 MiB of JSON, or a binary file whose header or first chunk is damaged.
GltfFile read_gltf(const std::filesystem::path& path);

// Bytes of buffers[buffer]: of the binary file itself, of a data URI, or of a file beside this one.
// Nothing if there are none.
std::optional<std::string> buffer_bytes(const GltfFile& file, std::uint64_t buffer,
                                        std::uint64_t begin, std::uint64_t count);

// A member of an object, an element of an array; null if there is no such thing, or no object or
// array to ask.
const nlohmann::json* member_of(const nlohmann::json* value, std::string_view key);
const nlohmann::json* element_of(const nlohmann::json* value, std::optional<std::uint64_t> index);

// A number that counts or points to something; nothing for any other value.
std::optional<std::uint64_t> whole_number(const nlohmann::json* value);

// A value as messages show it: one line of at most some 60 characters.
std::string short_text(const nlohmann::json& value);

}  // namespace ltc
