// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The beginning of a NumPy array's file.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ltc {

inline constexpr std::string_view npy_magic = "\x93NUMPY";

// That of an array of f32 in C order; the values follow.
std::string npy_header(std::span<const std::size_t> shape);

}  // namespace ltc
