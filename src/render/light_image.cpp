// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/light_image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/file.h"
#include "core/read_file.h"
#include "export/exr_header.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t channels = 4;
constexpr std::size_t most_file_bytes = std::size_t{1} << 30;
// No compression that images are written with makes more bytes out of one (deflate: 1,032 at most):
// a small file that claims a large image is refused before memory is taken for it.
constexpr std::size_t most_bytes_per_byte = 2000;
constexpr std::string_view png_signature = "\x89PNG\r\n\x1A\n";
constexpr std::string_view exr_signature = "v/1\x01";

void require_size(std::size_t width, std::size_t height, std::size_t bytes_a_pixel,
                  std::size_t file_bytes, const fs::path& path) {
  if (width == 0 || height == 0 || width > largest_light_image_side ||
      height > largest_light_image_side)
    refuse_file(path, fmt::format("{} x {} pixels; allowed: 1 to {} a side", width, height,
                                  largest_light_image_side));
  if (width * height * bytes_a_pixel > most_bytes_per_byte * file_bytes)
    refuse_file(
        path, fmt::format("{} bytes long; too few for {} x {} pixels", file_bytes, width, height));
}

LightImage blank(std::size_t width, std::size_t height) {
  return {width, height, std::vector<float>(channels * width * height, 1.0f)};
}

// ---- PNG ----

double decode_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// Reads 16 bits a channel, red, green, blue and alpha. Errors of the library come back by longjmp,
// over which no object may live that has a destructor: those here are made before.
class PngReader {
 public:
  PngReader(std::string_view bytes, const fs::path& path) : left_(bytes), path_(path) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &on_error, &on_warning);
    info_ = png_ ? png_create_info_struct(png_) : nullptr;
    if (!info_) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw IoError(fmt::format("cannot read {}: no memory", path.string()));
    }
    png_set_read_fn(png_, this, &on_read);
    png_set_user_limits(png_, 0x7fffffff, 0x7fffffff);  // ours are checked
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  LightImage read() {
    const std::size_t file_bytes = left_.size();
    if (!read_header())
      refuse();
    const std::size_t width = png_get_image_width(png_, info_),
                      height = png_get_image_height(png_, info_);
    // Of the kind that has the least.
    require_size(width, height, 1, file_bytes * 8, path_);
    values_.resize(channels * width * height);
    for (std::size_t row = 0; row < height; ++row)
      rows_.push_back(reinterpret_cast<png_bytep>(&values_[channels * width * row]));
    if (!read_rows())
      refuse();
    return linear(width, height);
  }

 private:
  static void on_error(png_structp png, png_const_charp text) {
    auto* const self = static_cast<PngReader*>(png_get_error_ptr(png));
    std::strncpy(self->error_, text, sizeof self->error_ - 1);
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}
  static void on_read(png_structp png, png_bytep target, std::size_t count) {
    auto* const self = static_cast<PngReader*>(png_get_io_ptr(png));
    if (count > self->left_.size())
      png_error(png, "cut short");
    std::memcpy(target, self->left_.data(), count);
    self->left_.remove_prefix(count);
  }

  bool read_header() {
    if (setjmp(png_jmpbuf(png_)))
      return false;
    png_read_info(png_, info_);
    png_set_expand_16(png_);  // palettes, greys of few bits and transparent colours too
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, 0xffff, PNG_FILLER_AFTER);
    png_set_swap(png_);  // little-endian, as the values are in memory
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  bool read_rows() {
    if (setjmp(png_jmpbuf(png_)))
      return false;
    png_read_image(png_, rows_.data());
    png_read_end(png_, nullptr);
    return true;
  }

  LightImage linear(std::size_t width, std::size_t height) const {
    LightImage image = blank(width, height);
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const double value = values_[i] / 65535.0;
      image.rgba[i] = static_cast<float>(i % channels == 3 ? value : decode_srgb(value));
    }
    return image;
  }

  [[noreturn]] void refuse() const {
    refuse_file(path_, fmt::format("a damaged PNG ({})", on_one_line(error_)));
  }

  std::string_view left_;
  const fs::path& path_;
  char error_[128] = {};
  std::vector<std::uint16_t> values_;
  std::vector<png_bytep> rows_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

// ---- OpenEXR ----

bool has_channel(const Imf::Header& header, const char* name) {
  const Imf::Channel* const channel = header.channels().findChannel(name);
  return channel && channel->type != Imf::UINT && channel->xSampling == 1 &&
         channel->ySampling == 1;
}

// The channels that are read into places 0, 1 and 2, or into place 0 alone.
std::vector<const char*> color_channels(const Imf::Header& header, const fs::path& path) {
  if (has_channel(header, "R") && has_channel(header, "G") && has_channel(header, "B"))
    return {"R", "G", "B"};
  if (has_channel(header, "Y"))
    return {"Y"};
  refuse_file(path, "neither channels R, G and B nor Y, float or half, at full resolution");
}

LightImage pixels_of(Imf::InputFile& file, std::size_t file_bytes, const fs::path& path) {
  const auto& window = file.header().dataWindow();
  const auto side = [](int first, int last) {
    return static_cast<std::size_t>(std::max(std::int64_t{last} - first + 1, std::int64_t{0}));
  };
  const std::size_t width = side(window.min.x, window.max.x),
                    height = side(window.min.y, window.max.y);
  require_size(width, height, sizeof(std::uint16_t), file_bytes, path);
  LightImage image = blank(width, height);
  const auto stride = static_cast<std::ptrdiff_t>(channels * sizeof(float));
  const std::ptrdiff_t row_stride = stride * static_cast<std::ptrdiff_t>(width);
  Imf::FrameBuffer buffer;
  const auto read_into = [&](std::size_t place, const char* channel) {
    char* const first = reinterpret_cast<char*>(image.rgba.data() + place) - window.min.x * stride -
                        window.min.y * row_stride;
    buffer.insert(channel, Imf::Slice(Imf::FLOAT, first, static_cast<std::size_t>(stride),
                                      static_cast<std::size_t>(row_stride)));
  };
  const std::vector<const char*> colors = color_channels(file.header(), path);
  for (std::size_t place = 0; place < colors.size(); ++place)
    read_into(place, colors[place]);
  if (has_channel(file.header(), "A"))
    read_into(3, "A");
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  if (colors.size() == 1)
    for (std::size_t i = 0; i < image.rgba.size(); i += channels)
      image.rgba[i + 1] = image.rgba[i + 2] = image.rgba[i];
  return image;
}

LightImage read_exr_image(const fs::path& path) {
  const std::size_t file_bytes = require_readable(path);
  if (const std::string fault = exr_header_fault(path); !fault.empty())
    refuse_file(path, fault);
  const BoundedExrSize bound(largest_light_image_side);
  try {
    constexpr int no_threads = 0;
    Imf::InputFile file(path.c_str(), no_threads);
    return pixels_of(file, file_bytes, path);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    refuse_file(path, fmt::format("a damaged OpenEXR file ({})", on_one_line(error.what())));
  }
}

void require_radiance(const LightImage& image, const fs::path& path) {
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    if (!(image.rgba[i] >= 0) || !std::isfinite(image.rgba[i]))
      refuse_file(path,
                  fmt::format("channel {} is {} in row {}, column {}; expected finite numbers "
                              "that are not negative",
                              "RGBA"[i % channels], image.rgba[i], i / channels / image.width,
                              i / channels % image.width));
}

}  // namespace

LightImage read_light_image(const fs::path& path) {
  const std::string beginning = read_first_bytes(path, "image", png_signature.size());
  LightImage image;
  if (beginning.starts_with(png_signature)) {
    const std::string bytes = read_whole_file(path, "image", most_file_bytes);
    image = PngReader(bytes, path).read();
  } else if (beginning.starts_with(exr_signature)) {
    image = read_exr_image(path);
  } else {
    refuse_file(path, "no image; expected PNG or OpenEXR");
  }
  require_radiance(image, path);
  return image;
}

}  // namespace ltc
