// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The names that values of an enum have in files, configs, options and messages: one list an enum.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"

namespace ltc {

template <typename Enum, std::size_t count>
struct EnumNames {
  std::string_view what;  // "storage", as messages call the enum
  std::array<std::pair<Enum, std::string_view>, count> pairs;
};

// An enum gets names by a function beside it, found by its argument's type alone:
//   constexpr EnumNames<Warp, 2> enum_names(Warp) { return {"warp", {{{Warp::linear, "linear"},
//   …}}}; }
template <typename Enum>
concept Named = requires {
  enum_names(Enum());
};

// Throws InputError for a value without a name.
template <Named Enum>
std::string_view name_of(Enum value) {
  static constexpr auto names = enum_names(Enum());
  for (const auto& [known, name] : names.pairs)
    if (known == value)
      return name;
  throw InputError(fmt::format("{} {} is unknown", names.what, static_cast<int>(value)));
}

template <Named Enum>
std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const auto& pair : enum_names(Enum()).pairs)
    names.emplace_back(pair.second);
  return names;
}

// Throws InputError, with the names that there are, for another one.
template <Named Enum>
Enum value_named(std::string_view name) {
  static constexpr auto names = enum_names(Enum());
  for (const auto& [value, known] : names.pairs)
    if (known == name)
      return value;
  throw InputError(fmt::format("{} \"{}\" is unknown; allowed: {}", names.what, name,
                               fmt::join(all_names<Enum>(), ", ")));
}

}  // namespace ltc
