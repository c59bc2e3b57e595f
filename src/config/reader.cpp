// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "config/reader.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "config/suggestion.h"
#include "config/toml_file.h"
#include "core/error.h"

namespace ltc::config {
namespace {

bool is_section(const Vocabulary& vocabulary, std::string_view name) {
  return std::any_of(vocabulary.keys.begin(), vocabulary.keys.end(), [&](const BoundKey& key) {
    return key.name.starts_with(name) && key.name.size() > name.size() &&
           key.name[name.size()] == '.';
  });
}

std::vector<std::string> key_names(const Vocabulary& vocabulary) {
  std::vector<std::string> names;
  for (const BoundKey& key : vocabulary.keys)
    names.push_back(key.name);
  return names;
}

void set_key(const std::string& name, const toml::node& node, const std::string& source,
             const Vocabulary& vocabulary, Sources& sources) {
  const std::vector<BoundKey>& keys = vocabulary.keys;
  const auto key = std::find_if(keys.begin(), keys.end(),
                                [&](const BoundKey& candidate) { return candidate.name == name; });
  const Value value = value_of(node);
  if (key == keys.end() && node.is_table())
    throw InputError(
        fmt::format("{}: unknown section {}; {}", source, name, vocabulary.where_listed));
  if (key == keys.end() && is_section(vocabulary, name))
    throw InputError(fmt::format("{}: {} = {}: {} is a section; expected a key in it", source, name,
                                 toml_of(value), name));
  if (key == keys.end())
    throw InputError(fmt::format("{}: unknown key {} = {}{}", source, name, toml_of(value),
                                 suggestion(name, key_names(vocabulary), vocabulary.where_listed)));
  if (!key->set(value))
    throw InputError(
        fmt::format("{}: {} = {}: expected {}", source, name, toml_of(value), key->allowed));
  sources.push_back({name, source});
}

using SourceOf = std::function<std::string(const toml::node&)>;

void set_keys(const std::string& prefix, const toml::table& table, const SourceOf& source_of,
              const Vocabulary& vocabulary, Sources& sources) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const toml::table* section = node.as_table(); section && is_section(vocabulary, name))
      set_keys(name + ".", *section, source_of, vocabulary, sources);
    else
      set_key(name, node, source_of(node), vocabulary, sources);
  }
}

}  // namespace

void read_file(const std::filesystem::path& file, const Vocabulary& vocabulary, Sources& sources) {
  read_text(read_toml_text(file, "config"), file, vocabulary, sources);
}

void read_text(std::string_view text, const std::filesystem::path& source,
               const Vocabulary& vocabulary, Sources& sources) {
  const toml::table root = [&] {
    try {
      return parse_toml(text, source);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}; {}", error.what(), vocabulary.where_listed));
    }
  }();
  set_keys(
      "", root, [&](const toml::node& node) { return place_of(source, node.source()); }, vocabulary,
      sources);
}

void read_override(std::string_view override, const std::string& source,
                   const Vocabulary& vocabulary, Sources& sources) {
  const std::size_t equals = override.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw InputError(
        fmt::format("{} {}: expected key=value, for example fit.seed=2", source, override));
  const std::string name(override.substr(0, equals));
  const std::string_view text = override.substr(equals + 1);
  const auto parsed = [&]() -> std::optional<toml::table> {
    try {
      toml::table table = toml::parse(fmt::format("value = {}", text));
      if (table.size() == 1)  // more if the text holds a line break and another key
        return table;
    } catch (const toml::parse_error&) {
    }
    return std::nullopt;
  }();
  if (parsed)
    set_key(name, *parsed->get("value"), source, vocabulary, sources);
  else
    set_key(name, toml::value<std::string>(std::string(text)), source, vocabulary, sources);
}

std::string latest_source(const Sources& sources, std::initializer_list<std::string_view> keys) {
  const auto latest = std::find_if(sources.rbegin(), sources.rend(), [&](const KeySource& said) {
    return std::find(keys.begin(), keys.end(), said.key) != keys.end();
  });
  return latest != sources.rend() ? latest->source : "config";
}

}  // namespace ltc::config
