// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Reads TOML into settings, key by key, and remembers where each key was said.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "config/key.h"

namespace ltc::config {

// A key with the settings that it sets.
struct BoundKey {
  std::string name, allowed;              // as KeyOf's
  std::function<bool(const Value&)> set;  // likewise
};

// What a file may say. `settings` and `keys` must outlive it.
struct Vocabulary {
  std::vector<BoundKey> keys;
  std::string where_listed;  // completes "unknown key …; ": "config/default.toml lists …"
};
template <typename Settings>
Vocabulary vocabulary(const std::vector<KeyOf<Settings>>& keys, Settings& settings,
                      std::string where_listed) {
  Vocabulary result{{}, std::move(where_listed)};
  for (const KeyOf<Settings>& key : keys)
    result.keys.push_back({key.name, key.allowed, [&key, &settings](const Value& value) {
                             return key.set(settings, value);
                           }});
  return result;
}

// Every key read so far, in order, and where: "config/default.toml:12", or what overrides go by.
struct KeySource {
  std::string key, source;
};
using Sources = std::vector<KeySource>;

// Sets what the file says. Throws IoError if it cannot be read, InputError for what it says.
void read_file(const std::filesystem::path& file, const Vocabulary& vocabulary, Sources& sources);

// Sets what a config at hand says; `source` stands in messages for the file. Throws InputError.
void read_text(std::string_view text, const std::filesystem::path& source,
               const Vocabulary& vocabulary, Sources& sources);

// Sets what one "key=value" says. Throws InputError, with `source` in front.
void read_override(std::string_view override, const std::string& source,
                   const Vocabulary& vocabulary, Sources& sources);

// Where the latest of these keys was said; "config" if all have their defaults.
std::string latest_source(const Sources& sources, std::initializer_list<std::string_view> keys);

}  // namespace ltc::config
