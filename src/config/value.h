// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The values that a config key can have, and how TOML spells them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace ltc::config {

// monostate stands for what no key takes: arrays, tables, dates.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

// The value as TOML: the shortest spelling that reads back to the same bits.
std::string toml_of(const Value& value);

// A basic TOML string with its quotes, control characters escaped: always one line.
std::string quoted(std::string_view text);

}  // namespace ltc::config
