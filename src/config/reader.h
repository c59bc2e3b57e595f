// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Reads TOML into a draft, key by key, and remembers where each key was said.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "config/draft.h"

namespace ltc::config {

// Every key read so far, in order, and where: "config/default.toml:12" or "--set".
struct KeySource {
  std::string key, source;
};
using Sources = std::vector<KeySource>;

// Sets what the file says. Throws IoError if it cannot be read, InputError for what it says.
void read_file(const std::filesystem::path& file, Draft& draft, Sources& sources);

// Sets what a config at hand says; `source` stands in messages for the file. Throws InputError.
void read_text(std::string_view text, const std::filesystem::path& source, Draft& draft,
               Sources& sources);

// Sets what one "key=value" says. Throws InputError.
void read_override(std::string_view override, Draft& draft, Sources& sources);

// Where the latest of these keys was said; "config" if all have their defaults.
std::string latest_source(const Sources& sources, std::initializer_list<std::string_view> keys);

}  // namespace ltc::config
