// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the readers of numbers in text share (number_text.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "export/image.h"

namespace ltc {

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
constexpr bool is_of_identifier(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || is_digit(c);
}

// The float nearest to an unsigned or negative decimal number. Throws InputError, naming the list
// and the file, for what is none or not finite as a float.
float number_of(std::string_view text, std::string_view list, const std::filesystem::path& file);

// The image of a list; `size` is (width, height, layers, channels), without which it is a square of
// 4 channels. Throws InputError if the size is not allowed or asks for another count.
Image image_of_list(const std::string& name, std::vector<float> values,
                    const std::optional<std::vector<std::uint64_t>>& size,
                    const std::filesystem::path& file);

}  // namespace ltc
