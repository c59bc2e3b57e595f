// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/dds.h"

#include <fmt/format.h>

#include "core/error.h"
#include "export/image_bytes.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;

// Offsets from the beginning of the file.
namespace at {
constexpr std::size_t size = 4, flags = 8, height = 12, width = 16, pitch = 20, depth = 24,
                      levels = 28, format_size = 76, format_flags = 80, four_cc = 84, caps = 108,
                      caps_2 = 112, dxgi_format = 128, dimension = 132, misc = 136,
                      array_size = 140;
}  // namespace at

constexpr std::string_view magic = "DDS ";
constexpr std::size_t legacy_bytes = 128, dx10_bytes = 148;
constexpr std::uint32_t header_size = 124, format_size = 32;
// Caps, height, width, pitch and pixel format: what ltc_code's files have.
constexpr std::uint32_t basic_flags = 0x100f, depth_flag = 0x800000, four_cc_flag = 4;
constexpr std::uint32_t texture_caps = 0x1000, cube_caps = 0x200, volume_caps = 0x200000;
constexpr std::uint32_t dimension_2d = 3, dimension_3d = 4, cube_misc = 4;
constexpr std::uint32_t dx10_code = 0x30315844;  // "DX10"

constexpr TexelFormat dxgi_formats[] = {
    {2, 4, Precision::single},  {6, 3, Precision::single}, {10, 4, Precision::half},
    {16, 2, Precision::single}, {34, 2, Precision::half},  {41, 1, Precision::single},
    {54, 1, Precision::half},
};
// D3DFORMAT.
constexpr TexelFormat d3d_formats[] = {
    {111, 1, Precision::half},   {112, 2, Precision::half},   {113, 4, Precision::half},
    {114, 1, Precision::single}, {115, 2, Precision::single}, {116, 4, Precision::single},
};

class Input {
 public:
  Input(std::string_view bytes, const fs::path& file) : bytes_(bytes), file_(file) {}

  Image image() const {
    if (!bytes_.starts_with(magic))
      refuse_file(file_, "no DDS file: it does not start with \"DDS \"");
    require_bytes(legacy_bytes);
    require(at::size, header_size, "size of the header");
    require(at::format_size, format_size, "size of the pixel format");
    if (!(field(at::format_flags) & four_cc_flag))
      refuse_file(file_, "its texels are described by bit masks; allowed: by a FourCC, of floats");
    if (field(at::levels) > 1)
      refuse_file(file_, fmt::format("{} mip levels; allowed: 1", field(at::levels)));
    if (field(at::caps_2) & cube_caps)
      refuse_cube();
    const bool dx10 = field(at::four_cc) == dx10_code;
    Image image = dx10 ? dx10_size() : legacy_size();
    image.width = field(at::width);
    image.height = field(at::height);
    require_size(image, file_.string());
    const std::size_t header = dx10 ? dx10_bytes : legacy_bytes;
    if (bytes_.size() != header + byte_count(image))
      refuse_file(file_, fmt::format("{} bytes long; its header asks for {}", bytes_.size(),
                                     header + byte_count(image)));
    image.values = values_of(bytes_.substr(header), image.precision);
    return image;
  }

 private:
  std::uint32_t field(std::size_t offset) const { return number_at<std::uint32_t>(bytes_, offset); }

  void require(std::size_t offset, std::uint32_t value, std::string_view what) const {
    if (field(offset) != value)
      refuse_file(file_, fmt::format("{} is {}; allowed: {}", what, field(offset), value));
  }

  void require_bytes(std::size_t count) const {
    if (bytes_.size() < count)
      refuse_file(file_,
                  fmt::format("cut short in the header: {} of {} bytes", bytes_.size(), count));
  }

  [[noreturn]] void refuse_cube() const {
    refuse_file(file_, "a cube map; allowed: 2-D, arrays, 3-D");
  }

  // Everything but width and height.
  Image dx10_size() const {
    require_bytes(dx10_bytes);
    const TexelFormat& format =
        format_coded(field(at::dxgi_format), dxgi_formats, "DXGI format", file_);
    if (field(at::misc) & cube_misc)
      refuse_cube();
    const std::uint32_t dimension = field(at::dimension), layers = field(at::array_size);
    if (dimension != dimension_2d && dimension != dimension_3d)
      refuse_file(file_,
                  fmt::format("resource dimension is {}; allowed: 3 (2-D), 4 (3-D)", dimension));
    if (dimension == dimension_3d)
      require(at::array_size, 1, "number of 3-D textures");
    Image image = image_of(format);
    image.layers = dimension == dimension_3d ? field(at::depth) : layers;
    image.shape = dimension == dimension_3d ? ImageShape::volume
                  : layers == 1             ? ImageShape::flat
                                            : ImageShape::array;
    return image;
  }

  Image legacy_size() const {
    const TexelFormat& format = format_coded(field(at::four_cc), d3d_formats, "FourCC", file_);
    Image image = image_of(format);
    if (field(at::caps_2) & volume_caps) {
      image.shape = ImageShape::volume;
      image.layers = field(at::depth);
    }
    return image;
  }

  std::string_view bytes_;
  const fs::path& file_;
};

}  // namespace

std::string encode_dds(const Image& image, DdsHeader header) {
  require_storable(image);
  const bool dx10 = header == DdsHeader::dx10, volume = image.shape == ImageShape::volume;
  if (!dx10 && image.shape == ImageShape::array)
    throw InputError(image_label(image) +
                     ": an array; allowed with the legacy header of DDS: flat, 3-D");
  const TexelFormat& format = dx10 ? format_of(image, dxgi_formats) : format_of(image, d3d_formats);
  std::string bytes(dx10 ? dx10_bytes : legacy_bytes, '\0');
  const auto put = [&](std::size_t offset, std::size_t value) {
    put_number(bytes, offset, static_cast<std::uint32_t>(value));
  };
  bytes.replace(0, magic.size(), magic);
  put(at::size, header_size);
  put(at::flags, basic_flags | (volume ? depth_flag : 0));
  put(at::height, image.height);
  put(at::width, image.width);
  put(at::pitch, byte_count(image) / (image.height * image.layers));
  put(at::depth, volume ? image.layers : 1);
  put(at::levels, 1);
  put(at::format_size, format_size);
  put(at::format_flags, four_cc_flag);
  put(at::four_cc, dx10 ? dx10_code : format.code);
  put(at::caps, texture_caps);
  put(at::caps_2, volume ? volume_caps : 0);
  if (dx10) {
    put(at::dxgi_format, format.code);
    put(at::dimension, volume ? dimension_3d : dimension_2d);
    put(at::array_size, volume ? 1 : image.layers);
  }
  return bytes + value_bytes(image);
}

Image decode_dds(std::string_view bytes, const fs::path& file) {
  return Input(bytes, file).image();
}

}  // namespace ltc
