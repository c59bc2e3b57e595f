// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the containers of textures share: sizes that are allowed, texel formats, values as bytes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/file.h"
#include "export/image.h"

namespace ltc {

static_assert(std::endian::native == std::endian::little,
              "numbers are copied as they lie in memory");

template <class T>
T number_at(std::string_view bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

template <class T>
void put_number(std::string& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof value);
}

// "image ltc_1", as messages call it.
std::string image_label(const Image& image);

// Width, height, layers and channels, all of them allowed and with no more values than allowed;
// otherwise InputError, which begins with `where`: the file or the image.
void require_size(const Image& image, std::string_view where);

// Also as many values as the size asks for, all of them finite and none beyond the precision.
void require_storable(const Image& image);

std::size_t bytes_per_value(Precision precision);
std::size_t value_count(const Image& image);
std::size_t byte_count(const Image& image);

// The value that the image's precision has for it.
float stored_value(float value, Precision precision);

// The values as they lie in files, little-endian, and back. What is not finite is read as it is.
std::string value_bytes(const Image& image);
std::vector<float> values_of(std::string_view bytes, Precision precision);

// What a container calls a kind of texel.
struct TexelFormat {
  std::uint32_t code;
  std::size_t channels;
  Precision precision;
};

// An image of such texels, of no size yet.
Image image_of(const TexelFormat& format);

// The format of the image. Throws InputError if there is none.
const TexelFormat& format_of(const Image& image, std::span<const TexelFormat> formats);

// The format with this code. Throws InputError: "x.dds: DXGI format is 98; allowed: 2 (RGBA32F),
// ...".
const TexelFormat& format_coded(std::uint32_t code, std::span<const TexelFormat> formats,
                                std::string_view what, const std::filesystem::path& file);

}  // namespace ltc
