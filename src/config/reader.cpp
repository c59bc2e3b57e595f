// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "config/reader.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "config/registry.h"
#include "core/error.h"

namespace ltc::config {
namespace {

constexpr std::size_t largest_file_bytes = 1 << 20;  // a config has a few kB; /dev/zero has no end

Value value_of(const toml::node& node) {
  if (const auto* boolean = node.as_boolean())
    return boolean->get();
  if (const auto* integer = node.as_integer())
    return integer->get();
  if (const auto* real = node.as_floating_point())
    return real->get();
  if (const auto* text = node.as_string())
    return text->get();
  return {};
}

// How many letters must change, come or go to make one word of the other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

bool is_section(std::string_view name) {
  return std::any_of(keys().begin(), keys().end(), [&](const Key& key) {
    return key.name.starts_with(name) && key.name.size() > name.size() &&
           key.name[name.size()] == '.';
  });
}

// Ready to append to a message: the key that was probably meant.
std::string suggestion(std::string_view unknown) {
  const auto last_word = [](std::string_view name) { return name.substr(name.rfind('.') + 1); };
  const auto distance = [&](const Key& key) {
    // The right word in a wrong section is near too: fit.steps for fit.sgd.steps.
    return std::min(edit_distance(key.name, unknown),
                    1 + edit_distance(last_word(key.name), last_word(unknown)));
  };
  const Key& nearest =
      *std::min_element(keys().begin(), keys().end(),
                        [&](const Key& a, const Key& b) { return distance(a) < distance(b); });
  if (distance(nearest) <= std::max<std::size_t>(2, unknown.size() / 4))
    return fmt::format("; did you mean {}?", nearest.name);
  return "; config/default.toml lists the keys there are";
}

void set_key(const std::string& name, const toml::node& node, const std::string& source,
             Draft& draft, Sources& sources) {
  const auto key = std::find_if(keys().begin(), keys().end(),
                                [&](const Key& candidate) { return candidate.name == name; });
  const Value value = value_of(node);
  if (key == keys().end() && is_section(name))
    throw InputError(fmt::format("{}: {} = {}: {} is a section; expected a key in it", source, name,
                                 toml_of(value), name));
  if (key == keys().end())
    throw InputError(
        fmt::format("{}: unknown key {} = {}{}", source, name, toml_of(value), suggestion(name)));
  if (!key->set(draft, value))
    throw InputError(
        fmt::format("{}: {} = {}: expected {}", source, name, toml_of(value), key->allowed));
  sources.push_back({name, source});
}

using SourceOf = std::function<std::string(const toml::node&)>;

void set_keys(const std::string& prefix, const toml::table& table, const SourceOf& source_of,
              Draft& draft, Sources& sources) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const toml::table* section = node.as_table(); section && is_section(name))
      set_keys(name + ".", *section, source_of, draft, sources);
    else
      set_key(name, node, source_of(node), draft, sources);
  }
}

std::string content_of(const std::filesystem::path& file) {
  const auto refuse = [&](std::string_view reason) {
    throw IoError(fmt::format("cannot read config {}: {}", file.string(), reason));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    refuse("it is a folder; expected a TOML file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(
      std::fopen(file.string().c_str(), "rb"), &std::fclose);
  if (!stream)
    refuse(std::strerror(errno));
  std::string content(largest_file_bytes + 1, '\0');
  content.resize(std::fread(content.data(), 1, content.size(), stream.get()));
  if (std::ferror(stream.get()))
    refuse(std::strerror(errno));
  if (content.size() > largest_file_bytes)
    throw InputError(fmt::format("{}: larger than {} bytes, which no config is", file.string(),
                                 largest_file_bytes));
  return content;
}

}  // namespace

void read_file(const std::filesystem::path& file, Draft& draft, Sources& sources) {
  const std::string content = content_of(file);
  const auto at = [&](const toml::source_region& region) {
    return fmt::format("{}:{}", file.string(), region.begin.line);
  };
  try {
    set_keys(
        "", toml::parse(content), [&](const toml::node& node) { return at(node.source()); }, draft,
        sources);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}: not TOML: {}", at(error.source()), error.description()));
  }
}

void read_override(std::string_view override, Draft& draft, Sources& sources) {
  const std::size_t equals = override.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw InputError(fmt::format("--set {}: expected key=value, for example fit.seed=2", override));
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
    set_key(name, *parsed->get("value"), "--set", draft, sources);
  else
    set_key(name, toml::value<std::string>(std::string(text)), "--set", draft, sources);
}

std::string latest_source(const Sources& sources, std::initializer_list<std::string_view> keys) {
  const auto latest = std::find_if(sources.rbegin(), sources.rend(), [&](const KeySource& said) {
    return std::find(keys.begin(), keys.end(), said.key) != keys.end();
  });
  return latest != sources.rend() ? latest->source : "config";
}

}  // namespace ltc::config
