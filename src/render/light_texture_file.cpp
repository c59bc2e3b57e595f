// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/light_texture_file.h"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "core/error.h"
#include "core/file.h"
#include "core/version.h"
#include "core/write_file.h"
#include "export/image_bytes.h"
#include "export/ktx2.h"

namespace ltc {
namespace {

constexpr std::size_t tile_side = 64;
constexpr std::size_t channels = 4;

void write_level(Imf::TiledOutputFile& file, const Image& image, int level) {
  std::string values = value_bytes(image);
  Imf::FrameBuffer buffer;
  const char* const names[channels] = {"R", "G", "B", "A"};
  for (std::size_t channel = 0; channel < channels; ++channel)
    buffer.insert(names[channel],
                  Imf::Slice(Imf::HALF, values.data() + sizeof(std::uint16_t) * channel,
                             sizeof(std::uint16_t) * channels,
                             sizeof(std::uint16_t) * channels * image.width));
  file.setFrameBuffer(buffer);
  file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
}

// Into memory first: the library does not report what fails when it closes a file.
std::string encode_exr(std::span<const Image> levels) {
  const int side = static_cast<int>(levels.front().width);
  const auto tile = static_cast<unsigned>(std::min(levels.front().width, tile_side));
  Imf::Header header(side, side);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.setTileDescription({tile, tile, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN});
  header.insert("ltc:generator", Imf::StringAttribute(generator()));
  for (const char* name : {"R", "G", "B", "A"})
    header.channels().insert(name, Imf::Channel(Imf::HALF));
  Imf::StdOSStream stream;
  {
    constexpr int no_threads = 0;
    Imf::TiledOutputFile file(stream, header, no_threads);
    for (std::size_t level = 0; level < levels.size(); ++level)
      write_level(file, levels[level], static_cast<int>(level));
  }  // the destructor writes the table of tile offsets
  return stream.str();
}

}  // namespace

bool is_light_texture_file(const std::filesystem::path& path) {
  return path.extension() == ".ktx2" || path.extension() == ".exr";
}

void write_light_texture(std::span<const Image> levels, const std::filesystem::path& path,
                         bool zstd) {
  if (!is_light_texture_file(path))
    throw InputError(
        fmt::format("{}: no suffix of a light's texture; allowed: .ktx2, .exr", path.string()));
  for (const Image& level : levels)
    require_storable(level);
  try {
    write_file(path, path.extension() == ".exr" ? encode_exr(levels) : encode_ktx2(levels, zstd));
  } catch (const Iex::BaseExc& error) {
    throw IoError(fmt::format("cannot write {}: {}", path.string(), on_one_line(error.what())));
  }
}

}  // namespace ltc
