// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/exr_header.h"

#include <ImfHeader.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/read_file.h"

namespace ltc {
namespace {

constexpr std::size_t most_header_bytes = 1 << 20;  // ours have two thousand
constexpr std::size_t longest_name = 255;
constexpr std::uint32_t exr_magic = 20000630;
// Flags beside the version: tiles, parts without an image, several parts.
constexpr std::uint32_t other_layouts = 0x200 | 0x800 | 0x1000;

// Types whose values have one size. The others that there are (previews, lists of texts) have
// lengths of their own inside, and no table needs them.
const std::map<std::string_view, std::size_t>& sizes_of_types() {
  static const std::map<std::string_view, std::size_t> sizes = {
      {"box2f", 16},      {"box2i", 16}, {"chromaticities", 32},
      {"compression", 1}, {"double", 8}, {"envmap", 1},
      {"float", 4},       {"int", 4},    {"keycode", 28},
      {"lineOrder", 1},   {"m33d", 72},  {"m33f", 36},
      {"m44d", 128},      {"m44f", 64},  {"rational", 8},
      {"timecode", 8},    {"v2d", 16},   {"v2f", 8},
      {"v2i", 8},         {"v3d", 24},   {"v3f", 12},
      {"v3i", 12}};
  return sizes;
}

// Takes from the front of some bytes; nothing once they are used up.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : left_(bytes) {}

  std::optional<std::string_view> take(std::size_t count) {
    if (count > left_.size())
      return std::nullopt;
    const std::string_view taken = left_.substr(0, count);
    left_.remove_prefix(count);
    return taken;
  }
  // A text closed by a zero byte, without it.
  std::optional<std::string_view> name() {
    const std::size_t end = left_.find('\0');
    if (end == std::string_view::npos || end > longest_name)
      return std::nullopt;
    const std::string_view taken = left_.substr(0, end);
    left_.remove_prefix(end + 1);
    return taken;
  }
  std::optional<std::uint32_t> number() {
    const auto taken = take(4);
    if (!taken)
      return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
      value = value << 8 | static_cast<unsigned char>((*taken)[i]);
    return value;
  }
  bool empty() const { return left_.empty(); }

 private:
  std::string_view left_;
};

// Names with sixteen bytes each, closed by an empty name.
bool is_channel_list(std::string_view value) {
  Bytes bytes(value);
  for (auto name = bytes.name(); name; name = bytes.name()) {
    if (name->empty())
      return bytes.empty();
    if (!bytes.take(16))
      return false;
  }
  return false;
}

bool has_the_size_of_its_type(std::string_view type, std::string_view value) {
  if (type == "string")
    return true;
  if (type == "chlist")
    return is_channel_list(value);
  const auto known = sizes_of_types().find(type);
  return known != sizes_of_types().end() && known->second == value.size();
}

std::string fault_of_attributes(Bytes& bytes) {
  for (auto name = bytes.name(); name; name = bytes.name()) {
    if (name->empty())
      return {};
    const auto type = bytes.name();
    const auto size = type ? bytes.number() : std::nullopt;
    const auto value = size ? bytes.take(*size) : std::nullopt;
    if (!value)
      return "header is damaged or cut short";
    if (!has_the_size_of_its_type(*type, *value))
      return fmt::format("header attribute {} of type {} has a value of {} bytes", *name, *type,
                         value->size());
  }
  return "header is damaged or cut short";
}

}  // namespace

std::string exr_header_fault(const std::filesystem::path& path) {
  const std::string beginning = read_first_bytes(path, "image", most_header_bytes);
  Bytes bytes(beginning);
  const auto magic = bytes.number(), version = bytes.number();
  if (magic != exr_magic || !version)
    return {};
  if (*version & other_layouts)
    return "not a single-part scan-line image";
  return fault_of_attributes(bytes);
}

BoundedExrSize::BoundedExrSize(std::size_t largest_side) {
  const int largest = static_cast<int>(largest_side);
  Imf::Header::setMaxImageSize(largest, largest);
}

BoundedExrSize::~BoundedExrSize() {
  Imf::Header::setMaxImageSize(0, 0);  // no bound, the library's default
}

}  // namespace ltc
