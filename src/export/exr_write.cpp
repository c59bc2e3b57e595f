// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables as three OpenEXR images, folded ones as four, each a 3-D texture laid out as an atlas:
// pixel x = phi + Nphi lambda, y = theta + Ntheta alpha. docs/files.md says which channel holds
// what. Writing.
#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "brdf/lobe_model.h"
#include "core/error.h"
#include "core/file.h"
#include "core/parallel.h"
#include "core/write_file.h"
#include "export/consistency.h"
#include "export/exr_layout.h"
#include "export/nearest.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;
using namespace exr_layout;

// Pixels of one file, R, G, B, A interleaved.
using Pixels = std::vector<float>;

void require_storable(const Table& table, std::size_t entry, float value, float largest,
                      const fs::path& file) {
  if (std::abs(value) <= largest)
    return;
  throw InputError(
      fmt::format("{}: entry ({}) holds {}; a texture of this depth holds finite values up to {}",
                  file.string(), fmt::join(table.grid.indices(entry), ", "), value, largest));
}

// Those of one file; `source` says whose values each entry has.
Pixels gather_pixels(const Table& table, const std::vector<std::size_t>& source, std::size_t file,
                     const fs::path& path, bool half) {
  const float largest = largest_value(half ? Precision::half : Precision::single);
  Pixels pixels(channels_per_file * table.grid.size());
  for (std::size_t entry = 0; entry < source.size(); ++entry) {
    float* const first = &pixels[channels_per_file * pixel(table.grid, entry)];
    for (std::size_t channel = 0; channel < channels_per_file; ++channel) {
      first[channel] = channel_value(table, source[entry], channels_per_file * file + channel);
      require_storable(table, source[entry], first[channel], largest, path);
    }
  }
  return pixels;
}

Imf::Header make_header(const Table& table, std::size_t file, Imf::PixelType type) {
  nlohmann::ordered_json axes, warps;
  for (std::size_t i = 0; i < Grid::axis_count; ++i) {
    const std::string name(table.grid.axis_names()[i]);
    axes[name] = table.grid.axis(i).nodes;
    warps[name] = name_of(table.grid.axis(i).warp);
  }
  const Size size = atlas_size(table.grid);
  Imf::Header header(static_cast<int>(size.width), static_cast<int>(size.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const char* channel : channel_names)
    header.channels().insert(channel, Imf::Channel(type));
  header.insert("ltc:format_version", Imf::IntAttribute(version));
  header.insert("ltc:axes", Imf::StringAttribute(axes.dump()));
  header.insert("ltc:warp", Imf::StringAttribute(warps.dump()));
  header.insert("ltc:storage", Imf::StringAttribute(std::string(name_of(table.storage))));
  header.insert("ltc:alpha_min", Imf::DoubleAttribute(table.grid.alpha_min));
  if (table.grid.model != &ggx())
    header.insert("ltc:brdf", Imf::StringAttribute(std::string(table.grid.model->name())));
  if (table.refined)
    header.insert("ltc:refined", Imf::IntAttribute(*table.refined));
  if (is_folded(table))
    header.insert("ltc:creases", Imf::StringAttribute(nlohmann::json(table.creases).dump()));
  header.insert("ltc:channels", Imf::StringAttribute(std::string(channel_contents[file])));
  return header;
}

// The library compresses by threads of its own for as long as this lives, if there is much to do:
// the bytes are the same.
class CompressingThreads {
 public:
  explicit CompressingThreads(std::size_t entries) {
    constexpr std::size_t many = std::size_t{1} << 20;
    if (entries >= many)
      Imf::setGlobalThreadCount(processor_count());
  }
  ~CompressingThreads() { Imf::setGlobalThreadCount(0); }
  CompressingThreads(const CompressingThreads&) = delete;
  CompressingThreads& operator=(const CompressingThreads&) = delete;
};

// The file's bytes. Into memory first: the library does not report what fails when it closes a
// file.
template <class T>
std::string encode(const Imf::Header& header, const std::vector<T>& pixels, Imf::PixelType type) {
  const std::size_t width = static_cast<std::size_t>(header.dataWindow().max.x) + 1;
  const std::size_t height = static_cast<std::size_t>(header.dataWindow().max.y) + 1;
  constexpr std::size_t pixel_bytes = channels_per_file * sizeof(T);
  Imf::FrameBuffer buffer;
  for (std::size_t channel = 0; channel < channels_per_file; ++channel) {
    // The library's slices point to non-const bytes for reading's sake; writing leaves them alone.
    char* const base = const_cast<char*>(reinterpret_cast<const char*>(pixels.data() + channel));
    buffer.insert(channel_names[channel], Imf::Slice(type, base, pixel_bytes, pixel_bytes * width));
  }
  Imf::StdOSStream stream;
  {
    Imf::OutputFile file(stream, header, Imf::globalThreadCount());
    file.setFrameBuffer(buffer);
    file.writePixels(static_cast<int>(height));
  }  // the destructor writes the table of line offsets
  return stream.str();
}

std::string encode_file(const Table& table, std::size_t file, const Pixels& pixels, bool half) {
  if (!half)
    return encode(make_header(table, file, Imf::FLOAT), pixels, Imf::FLOAT);
  const std::vector<::half> rounded(pixels.begin(), pixels.end());
  return encode(make_header(table, file, Imf::HALF), rounded, Imf::HALF);
}

// Skipped and failed entries take the values of nearest_fitted (export/nearest.h). Throws
// InputError for a table without values, and for a value that is not finite or beyond the 16-bit
// range.
void add_exr(platform::FileSet& set, const Table& table, const TableFiles& paths,
             const WriteOptions& options) {
  require_albedo(table, paths.front());
  const std::vector<std::size_t> source = nearest_fitted(table);
  const CompressingThreads threads(table.grid.size());
  // One after the other: of a big table each takes gigabytes.
  for (std::size_t file = 0; file < texels_of(table); ++file) {
    const Pixels pixels = gather_pixels(table, source, file, paths[file], options.half);
    try {
      add_file(set, paths[file], encode_file(table, file, pixels, options.half));
    } catch (const Iex::BaseExc& error) {
      throw IoError(
          fmt::format("cannot write {}: {}", paths[file].string(), on_one_line(error.what())));
    }
  }
}

}  // namespace

Format exr_format() {
  return {.name = "OpenEXR",
          .sets = {endings},
          .asked = &OutputSettings::exr,
          .contents = {.albedo = true, .loss = false},
          .entry_bytes = texels_per_entry * channels_per_file * 4,
          .half = &OutputSettings::exr_half,
          .of_folded = true,
          .folded_set = folded_endings,
          .read = read_exr,
          .add = add_exr};
}

}  // namespace ltc
