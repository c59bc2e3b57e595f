// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// TOML files with errors of one line that name the file and the line.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "config/value.h"

namespace ltc::config {

// The content of a file of at most 1 MiB; `kind` says in messages what it should be ("config").
// Throws IoError if it cannot be read, InputError if it is larger or not TOML.
toml::table read_toml(const std::filesystem::path& file, std::string_view kind);

// Such a content as it stands.
std::string read_toml_text(const std::filesystem::path& file, std::string_view kind);

// The same of text that is at hand; `source` stands in messages for the file.
toml::table parse_toml(std::string_view text, const std::filesystem::path& source);

// "config/default.toml:12": where something stands.
std::string place_of(const std::filesystem::path& file, const toml::source_region& region);

// The value of a node; monostate for arrays, tables and dates.
Value value_of(const toml::node& node);

}  // namespace ltc::config
