// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Floats as integers that sort alike, so that a value and the index it came from sort as one key.
#pragma once

#include <bit>
#include <cstdint>

namespace ltc {

// Monotone in `value` for all but NaN; -0 sorts below +0.
inline std::uint32_t ordered_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}
inline float from_ordered_bits(std::uint32_t bits) {
  return std::bit_cast<float>(bits & 0x80000000u ? bits & 0x7fffffffu : ~bits);
}

// A key that sorts by value, then by index.
inline std::uint64_t sort_key(float value, std::uint32_t index) {
  return static_cast<std::uint64_t>(ordered_bits(value)) << 32 | index;
}
inline float key_value(std::uint64_t key) {
  return from_ordered_bits(static_cast<std::uint32_t>(key >> 32));
}
inline std::uint32_t key_index(std::uint64_t key) {
  return static_cast<std::uint32_t>(key);
}

}  // namespace ltc
