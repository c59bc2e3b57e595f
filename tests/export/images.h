// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Images for the tests of containers.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>

#include "core/error.h"
#include "export/image.h"
#include "support/refusal.h"

namespace ltc::testing {

// Values that halves hold, no two of them the same, of both signs.
inline Image numbered_image(ImageShape shape, Precision precision, std::size_t channels = 4,
                            std::size_t width = 5, std::size_t height = 3) {
  Image image;
  image.shape = shape;
  image.width = width;
  image.height = height;
  image.layers = shape == ImageShape::flat ? 1 : 2;
  image.channels = channels;
  image.precision = precision;
  for (std::size_t i = 0; i < image.texels() * channels; ++i)
    image.values.push_back((i % 2 ? -1.0f : 1.0f) * static_cast<float>(i) / 64);
  return image;
}

inline constexpr ImageShape all_shapes[] = {ImageShape::flat, ImageShape::array,
                                            ImageShape::volume};
inline constexpr Precision all_precisions[] = {Precision::single, Precision::half};

// The bytes with another number at an offset.
template <class T>
std::string with(std::string bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof value);
  return bytes;
}

// The number at an offset.
template <class T = std::uint32_t>
T field(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

inline void expect_refusal(const std::function<void()>& action, const std::string& part) {
  test::expect_one_line(test::message_of<InputError>(action), {part});
}

}  // namespace ltc::testing
