// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The range of an accessor's values.
#include <algorithm>
#include <bit>
#include <cmath>

#include "scene/gltf_animation.h"

namespace ltc {
namespace {

using nlohmann::json;

// How numbers are stored: `bytes` each, whole ones stand for shares of `largest`.
struct Component {
  std::uint64_t bytes;
  double largest;  // 0: a float
};

std::optional<Component> component_of(const json& accessor) {
  constexpr std::uint64_t byte = 5120, unsigned_byte = 5121, short_ = 5122, unsigned_short = 5123,
                          float_ = 5126;
  const auto type = whole_number(member_of(&accessor, "componentType"));
  if (type == float_)
    return Component{4, 0};
  // Whole numbers that are not shares of one are beyond what a factor can be.
  const json* const normalized = member_of(&accessor, "normalized");
  if (!normalized || *normalized != true)
    return std::nullopt;
  if (type == byte)
    return Component{1, 127};
  if (type == unsigned_byte)
    return Component{1, 255};
  if (type == short_)
    return Component{2, 32767};
  if (type == unsigned_short)
    return Component{2, 65535};
  return std::nullopt;
}

double value_at(const std::string& bytes, std::uint64_t at, const Component& component) {
  std::uint32_t bits = 0;
  for (std::uint64_t i = 0; i < component.bytes; ++i)
    bits |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  if (component.largest == 0)
    return double{std::bit_cast<float>(bits)};
  const bool is_signed = component.largest == 127 || component.largest == 32767;
  const double whole = bits;
  return (is_signed && whole > component.largest ? whole - 2 * component.largest - 2 : whole) /
         component.largest;
}

std::optional<Interval> stated_range(const json& accessor, const Component& component) {
  const json* const low = element_of(member_of(&accessor, "min"), 0);
  const json* const high = element_of(member_of(&accessor, "max"), 0);
  if (!low || !high || !low->is_number() || !high->is_number())
    return std::nullopt;
  const double scale = component.largest == 0 ? 1 : component.largest;
  const Interval range{low->get<double>() / scale, high->get<double>() / scale};
  return range.low <= range.high ? std::optional(range) : std::nullopt;
}

// A whole number below 2^32, so that products and sums of some do not wrap.
std::optional<std::uint64_t> small_number(const json* object, std::string_view key,
                                          std::uint64_t otherwise) {
  const json* const value = member_of(object, key);
  if (!value)
    return otherwise;
  const auto number = whole_number(value);
  return number && *number <= UINT32_MAX ? number : std::nullopt;
}

std::optional<Interval> range_of_values(const GltfFile& file, const json& accessor,
                                        const Component& component, std::uint64_t& bytes_left) {
  const json* const view = element_of(member_of(&file.root, "bufferViews"),
                                      whole_number(member_of(&accessor, "bufferView")));
  // What else says where values are: sparse ones, compression, streams.
  if (!view || member_of(&accessor, "sparse") || member_of(&accessor, "extensions") ||
      member_of(view, "extensions"))
    return std::nullopt;
  const auto buffer = whole_number(member_of(view, "buffer"));
  const auto view_begin = small_number(view, "byteOffset", 0);
  const auto view_bytes = small_number(view, "byteLength", 0);
  const auto stride = small_number(view, "byteStride", component.bytes);
  const auto begin = small_number(&accessor, "byteOffset", 0);
  const auto count = small_number(&accessor, "count", 0);
  if (!buffer || !view_begin || !view_bytes || !stride || !begin || !count || *count == 0 ||
      *stride < component.bytes)
    return std::nullopt;
  const std::uint64_t length = (*count - 1) * *stride + component.bytes;
  if (*begin + length > *view_bytes)
    return std::nullopt;
  const std::uint64_t end = *view_begin + *begin + length;
  if (end > bytes_left)
    return std::nullopt;
  bytes_left -= end;
  const auto bytes = buffer_bytes(file, *buffer, end - length, length);
  if (!bytes)
    return std::nullopt;
  Interval range{INFINITY, -INFINITY};
  for (std::uint64_t i = 0; i < *count; ++i) {
    const double value = value_at(*bytes, i * *stride, component);
    if (std::isnan(value))
      return std::nullopt;
    range = {std::min(range.low, value), std::max(range.high, value)};
  }
  return range;
}

}  // namespace

std::optional<Interval> accessor_range(const GltfFile& file, std::optional<std::uint64_t> index,
                                       std::uint64_t& bytes_left) {
  const json* const accessor = element_of(member_of(&file.root, "accessors"), index);
  const json* const type = member_of(accessor, "type");
  if (!type || *type != "SCALAR")
    return std::nullopt;
  const auto component = component_of(*accessor);
  if (!component)
    return std::nullopt;
  if (const auto stated = stated_range(*accessor, *component))
    return stated;
  return range_of_values(file, *accessor, *component, bytes_left);
}

}  // namespace ltc
