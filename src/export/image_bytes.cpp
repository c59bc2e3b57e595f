// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/image_bytes.h"

#include <half.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "core/file.h"

namespace ltc {
namespace {

std::string name_of_format(const TexelFormat& format) {
  return fmt::format("{}{}F", std::string_view("RGBA").substr(0, format.channels),
                     8 * bytes_per_value(format.precision));
}

void require_values(const Image& image) {
  const float largest = largest_value(image.precision);
  const auto bad = std::find_if(image.values.begin(), image.values.end(),
                                [=](float value) { return !(std::abs(value) <= largest); });
  if (bad == image.values.end())
    return;
  const auto at = static_cast<std::size_t>(bad - image.values.begin());
  const std::size_t texel = at / image.channels, row = texel / image.width;
  throw InputError(fmt::format(
      "{}: channel {} of texel ({}, {}) in layer {} is {}; {} bits hold finite values up to {}",
      image_label(image), at % image.channels, texel % image.width, row % image.height,
      row / image.height, *bad, 8 * bytes_per_value(image.precision), largest));
}

}  // namespace

std::string image_label(const Image& image) {
  return image.name.empty() ? "image" : fmt::format("image {}", on_one_line(image.name));
}

void require_size(const Image& image, std::string_view where) {
  const auto side = [](std::size_t n) { return n >= 1 && n <= max_image_side; };
  const std::string size = fmt::format("{} x {} x {} texels of {} channels", image.width,
                                       image.height, image.layers, image.channels);
  if (!side(image.width) || !side(image.height) || !side(image.layers) || image.channels < 1 ||
      image.channels > most_channels)
    throw InputError(fmt::format("{}: {}; allowed: 1 to {} texels a side, 1 to {} channels", where,
                                 size, max_image_side, most_channels));
  if (value_count(image) > max_image_values)
    throw InputError(
        fmt::format("{}: {}; allowed: up to {} values", where, size, max_image_values));
  if (image.shape == ImageShape::flat && image.layers != 1)
    throw InputError(fmt::format("{}: flat, with {} layers; allowed: 1", where, image.layers));
}

void require_storable(const Image& image) {
  require_size(image, image_label(image));
  if (image.values.size() != value_count(image))
    throw InputError(fmt::format("{}: {} values; {} x {} x {} texels of {} channels ask for {}",
                                 image_label(image), image.values.size(), image.width, image.height,
                                 image.layers, image.channels, value_count(image)));
  require_values(image);
}

std::size_t bytes_per_value(Precision precision) {
  return precision == Precision::half ? 2 : 4;
}

std::size_t value_count(const Image& image) {
  return image.texels() * image.channels;
}

std::size_t byte_count(const Image& image) {
  return value_count(image) * bytes_per_value(image.precision);
}

float stored_value(float value, Precision precision) {
  return precision == Precision::half ? static_cast<float>(::half(value)) : value;
}

std::string value_bytes(const Image& image) {
  std::string bytes(byte_count(image), '\0');
  if (image.precision == Precision::single) {
    std::memcpy(bytes.data(), image.values.data(), bytes.size());
    return bytes;
  }
  for (std::size_t i = 0; i < image.values.size(); ++i)
    put_number(bytes, 2 * i, ::half(image.values[i]).bits());
  return bytes;
}

std::vector<float> values_of(std::string_view bytes, Precision precision) {
  std::vector<float> values(bytes.size() / bytes_per_value(precision));
  if (precision == Precision::single) {
    if (!values.empty())
      std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = ::half(::half::FromBits, number_at<std::uint16_t>(bytes, 2 * i));
  return values;
}

Image image_of(const TexelFormat& format) {
  Image image;
  image.channels = format.channels;
  image.precision = format.precision;
  return image;
}

const TexelFormat& format_of(const Image& image, std::span<const TexelFormat> formats) {
  for (const TexelFormat& format : formats)
    if (format.channels == image.channels && format.precision == image.precision)
      return format;
  std::vector<std::string> names;
  for (const TexelFormat& format : formats)
    names.push_back(name_of_format(format));
  throw InputError(fmt::format("{}: {} channels of {} bits; allowed: {}", image_label(image),
                               image.channels, 8 * bytes_per_value(image.precision),
                               fmt::join(names, ", ")));
}

const TexelFormat& format_coded(std::uint32_t code, std::span<const TexelFormat> formats,
                                std::string_view what, const std::filesystem::path& file) {
  for (const TexelFormat& format : formats)
    if (format.code == code)
      return format;
  std::vector<std::string> names;
  for (const TexelFormat& format : formats)
    names.push_back(fmt::format("{} ({})", format.code, name_of_format(format)));
  refuse_file(file, fmt::format("{} is {}; allowed: {}", what, code, fmt::join(names, ", ")));
}

}  // namespace ltc
