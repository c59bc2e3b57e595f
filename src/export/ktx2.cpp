// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/ktx2.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/version.h"
#include "export/image_bytes.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;

// Offsets from the beginning of the file.
namespace at {
constexpr std::size_t vk_format = 12, type_size = 16, width = 20, height = 24, depth = 28,
                      layers = 32, faces = 36, levels = 40, scheme = 44, description = 48,
                      description_length = 52, key_values = 56, key_values_length = 60,
                      level_offset = 80, level_length = 88, level_uncompressed = 96;
}  // namespace at

constexpr std::string_view identifier = "\xABKTX 20\xBB\r\n\x1A\n";
constexpr std::size_t header_bytes = 104;  // with the index of one level
constexpr std::size_t bytes_of_index_entry = 24;
constexpr std::uint32_t scheme_none = 0, scheme_zstd = 2;

// VkFormat.
constexpr TexelFormat vk_formats[] = {
    {76, 1, Precision::half},    {83, 2, Precision::half},    {90, 3, Precision::half},
    {97, 4, Precision::half},    {100, 1, Precision::single}, {103, 2, Precision::single},
    {106, 3, Precision::single}, {109, 4, Precision::single},
};

// What a few bytes expand to is refused before memory is taken for it.
bool may_expand(std::size_t compressed, std::size_t expanded) {
  return expanded <= std::size_t{64} << 20 || expanded / 256 <= compressed;
}

template <class T>
void append(std::string& bytes, T value) {
  bytes.resize(bytes.size() + sizeof value);
  put_number(bytes, bytes.size() - sizeof value, value);
}

// Khronos's basic description of the texels: linear, BT.709, one sample a channel, signed floats.
std::string description_of(const Image& image) {
  constexpr std::uint8_t channel_ids[] = {0, 1, 2, 15}, float_signed = 0xc0;
  constexpr std::uint8_t color_model_rgbsda = 1, primaries_bt709 = 1, transfer_linear = 1;
  const std::size_t block = 24 + 16 * image.channels;
  std::string bytes;
  append(bytes, static_cast<std::uint32_t>(4 + block));
  append(bytes, std::uint32_t{0});  // Khronos's, basic
  append(bytes, std::uint16_t{2});
  append(bytes, static_cast<std::uint16_t>(block));
  bytes += {color_model_rgbsda, primaries_bt709, transfer_linear, 0};
  append(bytes, std::uint32_t{0});  // blocks of one texel
  append(bytes, static_cast<std::uint64_t>(image.channels *
                                           bytes_per_value(image.precision)));  // one plane
  for (std::size_t channel = 0; channel < image.channels; ++channel) {
    append(bytes, static_cast<std::uint16_t>(8 * bytes_per_value(image.precision) * channel));
    append(bytes, static_cast<std::uint8_t>(8 * bytes_per_value(image.precision) - 1));
    append(bytes, static_cast<std::uint8_t>(channel_ids[channel] | float_signed));
    append(bytes, std::uint32_t{0});
    append(bytes, -1.0f);
    append(bytes, 1.0f);
  }
  return bytes;
}

std::string key_values() {
  std::string entry = std::string("KTXwriter") + '\0' + "ltcfit " + std::string(version()) + '\0';
  std::string bytes;
  append(bytes, static_cast<std::uint32_t>(entry.size()));
  bytes += entry;
  bytes.resize((bytes.size() + 3) / 4 * 4);
  return bytes;
}

std::string compressed(const std::string& bytes) {
  // A tenth smaller by the highest level, which takes a second for 4 MiB.
  const int zstd_level = bytes.size() <= std::size_t{16} << 20 ? 19 : 9;
  std::string result(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(result.data(), result.size(), bytes.data(), bytes.size(), zstd_level);
  if (ZSTD_isError(size))
    throw IoError(fmt::format("cannot compress with Zstandard: {}", ZSTD_getErrorName(size)));
  result.resize(size);
  return result;
}

// All of them compressed, or nothing where our own reader took one for a bomb.
std::optional<std::vector<std::string>> all_compressed(const std::vector<std::string>& levels) {
  std::vector<std::string> result;
  for (const std::string& level : levels) {
    result.push_back(compressed(level));
    if (!may_expand(result.back().size(), level.size()))
      return std::nullopt;
  }
  return result;
}

void require_mip_levels(std::span<const Image> levels) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const auto side = [&](std::size_t full) { return std::max(full >> i, std::size_t{1}); };
    const Image &level = levels[i], &base = levels.front();
    if (level.shape != ImageShape::flat || level.channels != base.channels ||
        level.precision != base.precision || level.width != side(base.width) ||
        level.height != side(base.height))
      throw InputError(
          fmt::format("mip level {} is {} x {} texels of {} channels; expected a flat "
                      "one, {} x {} of {}",
                      i, level.width, level.height, level.channels, side(base.width),
                      side(base.height), base.channels));
  }
  if (levels.empty())
    throw InputError("a texture without a mip level; expected at least one");
}

std::string encoded(std::span<const Image> levels, bool zstd) {
  for (const Image& level : levels)
    require_storable(level);
  const Image& image = levels.front();
  const TexelFormat& format = format_of(image, vk_formats);
  std::string bytes(header_bytes + bytes_of_index_entry * (levels.size() - 1), '\0');
  const auto put = [&](std::size_t offset, std::size_t value) {
    put_number(bytes, offset, static_cast<std::uint32_t>(value));
  };
  bytes.replace(0, identifier.size(), identifier);
  put(at::vk_format, format.code);
  put(at::type_size, bytes_per_value(image.precision));
  put(at::width, image.width);
  put(at::height, image.height);
  put(at::depth, image.shape == ImageShape::volume ? image.layers : 0);
  put(at::layers, image.shape == ImageShape::array ? image.layers : 0);
  put(at::faces, 1);
  put(at::levels, levels.size());
  for (const auto& [offset, block] : {std::pair{at::description, description_of(image)},
                                      std::pair{at::key_values, key_values()}}) {
    put(offset, bytes.size());
    put(offset + 4, block.size());
    bytes += block;
  }
  std::vector<std::string> contents;
  for (const Image& level : levels)
    contents.push_back(value_bytes(level));
  for (std::size_t i = 0; i < levels.size(); ++i)
    put_number(bytes, at::level_uncompressed + bytes_of_index_entry * i,
               std::uint64_t{contents[i].size()});
  if (zstd)
    if (auto small = all_compressed(contents)) {
      put(at::scheme, scheme_zstd);
      contents = std::move(*small);
    }
  // The smallest first, so that a reader has something to show early.
  for (std::size_t i = levels.size(); i-- > 0;) {
    if (bytes[at::scheme] == scheme_none)  // aligned to texels and to four bytes
      while (bytes.size() %
             std::lcm(image.channels * bytes_per_value(image.precision), std::size_t{4}))
        bytes += '\0';
    const std::size_t entry = bytes_of_index_entry * i;
    put_number(bytes, at::level_offset + entry, std::uint64_t{bytes.size()});
    put_number(bytes, at::level_length + entry, std::uint64_t{contents[i].size()});
    bytes += contents[i];
  }
  return bytes;
}

class Input {
 public:
  Input(std::string_view bytes, const fs::path& file) : bytes_(bytes), file_(file) {}

  Image image() const {
    if (!bytes_.starts_with(identifier))
      refuse_file(file_, "no KTX 2.0 file: it does not start with its identifier");
    if (bytes_.size() < header_bytes)
      refuse_file(file_, fmt::format("cut short in the header: {} of {} bytes", bytes_.size(),
                                     header_bytes));
    Image image = size();
    require_size(image, file_.string());
    require_blocks();
    const std::string_view level = level_bytes();
    const auto stated = number_at<std::uint64_t>(bytes_, at::level_uncompressed);
    if (stated != byte_count(image))
      refuse_file(file_, fmt::format("its level has {} bytes uncompressed; its size asks for {}",
                                     stated, byte_count(image)));
    if (field(at::scheme) == scheme_zstd) {
      image.values = values_of(expanded(level, byte_count(image)), image.precision);
    } else {
      if (level.size() != byte_count(image))
        refuse_file(file_, fmt::format("its level has {} bytes; its size asks for {}", level.size(),
                                       byte_count(image)));
      image.values = values_of(level, image.precision);
    }
    return image;
  }

 private:
  std::uint32_t field(std::size_t offset) const { return number_at<std::uint32_t>(bytes_, offset); }

  void require(bool holds, std::size_t offset, std::string_view what,
               std::string_view allowed) const {
    if (!holds)
      refuse_file(file_, fmt::format("{} is {}; allowed: {}", what, field(offset), allowed));
  }

  Image size() const {
    const TexelFormat& format = format_coded(field(at::vk_format), vk_formats, "vkFormat", file_);
    Image image = image_of(format);
    const std::string type_size = std::to_string(bytes_per_value(image.precision));
    require(field(at::type_size) == bytes_per_value(image.precision), at::type_size, "typeSize",
            type_size);
    require(field(at::faces) == 1, at::faces, "number of faces", "1: 2-D, arrays, 3-D");
    require(field(at::levels) <= 1, at::levels, "number of mip levels", "1");
    const std::uint32_t scheme = field(at::scheme);
    require(scheme == scheme_none || scheme == scheme_zstd, at::scheme, "supercompression scheme",
            "0 (none), 2 (Zstandard)");
    const std::uint32_t depth = field(at::depth), layers = field(at::layers);
    require(depth == 0 || layers == 0, at::layers, "number of 3-D textures", "0 (no array)");
    image.width = field(at::width);
    image.height = field(at::height);
    image.layers = depth ? depth : layers ? layers : 1;
    image.shape = depth ? ImageShape::volume : layers ? ImageShape::array : ImageShape::flat;
    return image;
  }

  // The texels are described by the format; what else describes them must at least be there.
  void require_blocks() const {
    for (const std::size_t block : {at::description, at::key_values})
      if (std::uint64_t{field(block)} + field(block + 4) > bytes_.size())
        refuse_file(file_, fmt::format("{} bytes of {} at {}; the file has {}", field(block + 4),
                                       block == at::description ? "format descriptor" : "metadata",
                                       field(block), bytes_.size()));
  }

  std::string_view level_bytes() const {
    const auto offset = number_at<std::uint64_t>(bytes_, at::level_offset);
    const auto length = number_at<std::uint64_t>(bytes_, at::level_length);
    if (offset < header_bytes || offset > bytes_.size() || length != bytes_.size() - offset)
      refuse_file(file_, fmt::format("a level of {} bytes at {}; the file has {}, and ends with it",
                                     length, offset, bytes_.size()));
    return bytes_.substr(offset);
  }

  std::string expanded(std::string_view level, std::size_t size) const {
    const unsigned long long stated = ZSTD_getFrameContentSize(level.data(), level.size());
    if (stated == ZSTD_CONTENTSIZE_ERROR)
      refuse_file(file_, "its level is no Zstandard frame");
    if (stated == ZSTD_CONTENTSIZE_UNKNOWN)
      refuse_file(file_, "its Zstandard frame does not say its size");
    if (stated != size)
      refuse_file(file_, fmt::format("its Zstandard frame holds {} bytes; its size asks for {}",
                                     stated, size));
    if (!may_expand(level.size(), size))
      refuse_file(file_, fmt::format("{} bytes that expand to {}; allowed beyond 64 MiB: 256 times",
                                     level.size(), size));
    std::string result(size, '\0');
    const std::size_t count =
        ZSTD_decompress(result.data(), result.size(), level.data(), level.size());
    if (ZSTD_isError(count) || count != size)
      refuse_file(file_, fmt::format("its Zstandard frame is damaged: {}",
                                     ZSTD_isError(count) ? ZSTD_getErrorName(count) : "too short"));
    return result;
  }

  std::string_view bytes_;
  const fs::path& file_;
};

}  // namespace

std::string encode_ktx2(const Image& image, bool zstd) {
  return encoded(std::span(&image, 1), zstd);
}

std::string encode_ktx2(std::span<const Image> levels, bool zstd) {
  require_mip_levels(levels);
  return encoded(levels, zstd);
}

Image decode_ktx2(std::string_view bytes, const fs::path& file) {
  return Input(bytes, file).image();
}

}  // namespace ltc
