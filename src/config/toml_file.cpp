// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "config/toml_file.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/read_file.h"

namespace ltc::config {

toml::table read_toml(const std::filesystem::path& file, std::string_view kind) {
  return parse_toml(read_toml_text(file, kind), file);
}

std::string read_toml_text(const std::filesystem::path& file, std::string_view kind) {
  constexpr std::size_t largest_bytes = 1 << 20;  // people write a few kB; /dev/zero has no end
  return read_whole_file(file, kind, largest_bytes);
}

toml::table parse_toml(std::string_view text, const std::filesystem::path& source) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}: not TOML: {}", place_of(source, error.source()), error.description()));
  }
}

std::string place_of(const std::filesystem::path& file, const toml::source_region& region) {
  return fmt::format("{}:{}", file.string(), region.begin.line);
}

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

}  // namespace ltc::config
