// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The JSON of a glTF 2.0 file, text or binary, without what says nothing about materials.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace ltc {

// The root object with its members asset and materials, of a file whose asset.version is 2.x; other
// members are left out. Throws IoError if the file cannot be read; InputError if it is no such
// file: not JSON or not UTF-8, nested deeper than 64 levels, more than 256 MiB of JSON, or a binary
// file whose header or first chunk is damaged.
nlohmann::json read_gltf(const std::filesystem::path& file);

// A value as messages show it: one line of at most some 60 characters.
std::string short_text(const nlohmann::json& value);

}  // namespace ltc
