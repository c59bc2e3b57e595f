// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables as three OpenEXR images: reading.
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfStringAttribute.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "brdf/lobe_model.h"
#include "core/error.h"
#include "core/file.h"
#include "export/consistency.h"
#include "export/exr_header.h"
#include "export/exr_layout.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;
using namespace exr_layout;

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw InputError(fmt::format("{}: {}", path.string(), on_one_line(what)));
}

// The value of an attribute of type Attribute.
template <class Attribute>
auto attribute(const Imf::Header& header, const char* name, const fs::path& path) {
  const Attribute* const found = header.findTypedAttribute<Attribute>(name);
  if (!found)
    refuse(path, fmt::format("header attribute {} is missing or not of type {}", name,
                             Attribute::staticTypeName()));
  return found->value();
}

nlohmann::json json_attribute(const Imf::Header& header, const char* name, const fs::path& path) {
  return nlohmann::json::parse(attribute<Imf::StringAttribute>(header, name, path));
}

Grid read_grid(const Imf::Header& header, const fs::path& path) {
  Grid grid;
  try {
    const nlohmann::json axes = json_attribute(header, "ltc:axes", path);
    const nlohmann::json warps = json_attribute(header, "ltc:warp", path);
    for (std::size_t i = 0; i < Grid::axis_count; ++i) {
      const std::string name(grid.axis_names()[i]);
      grid.axis(i) = {axes.at(name).get<std::vector<double>>(),
                      value_named<Warp>(warps.at(name).get<std::string>())};
    }
  } catch (const nlohmann::json::exception& error) {
    refuse(path, fmt::format("header attribute ltc:axes or ltc:warp: {}", error.what()));
  }
  grid.alpha_min = attribute<Imf::DoubleAttribute>(header, "ltc:alpha_min", path);
  if (constexpr const char* brdf = "ltc:brdf"; header.find(brdf) != header.end())
    try {
      grid.model = &lobe_model(attribute<Imf::StringAttribute>(header, brdf, path));
    } catch (const InputError& error) {
      refuse(path, fmt::format("{}: {}", brdf, error.what()));
    }
  require_consistent(grid, path);
  return grid;
}

// Nothing where the file does not say.
std::optional<bool> read_refined(const Imf::Header& header, const fs::path& path) {
  constexpr const char* name = "ltc:refined";
  if (header.find(name) == header.end())
    return std::nullopt;
  const int refined = attribute<Imf::IntAttribute>(header, name, path);
  if (refined != 0 && refined != 1)
    refuse(path, fmt::format("{} is {}; allowed: 0 and 1", name, refined));
  return refined == 1;
}

// Of folded lobes alone.
Creases read_creases(const Imf::Header& header, const Table& table, const fs::path& path) {
  if (!is_folded(table))
    return {};
  Creases creases;
  try {
    creases = json_attribute(header, "ltc:creases", path).get<Creases>();
  } catch (const nlohmann::json::exception& error) {
    refuse(path, fmt::format("header attribute ltc:creases: {}", error.what()));
  }
  require_creases(creases, path);
  return creases;
}

bool has_half_channel(const Imf::Header& header) {
  for (const char* name : channel_names)
    if (header.channels().findChannel(name)->type == Imf::HALF)
      return true;
  return false;
}

void require_channels(const Imf::Header& header, std::size_t index, const fs::path& path) {
  const auto expected = channel_contents[index];
  const auto found = attribute<Imf::StringAttribute>(header, "ltc:channels", path);
  if (found != expected)
    refuse(path, fmt::format("ltc:channels is \"{}\"; expected: \"{}\"", found, expected));
  std::size_t count = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    ++count;
  for (const char* name : channel_names) {
    const Imf::Channel* const channel = header.channels().findChannel(name);
    if (count != channels_per_file || !channel || channel->type == Imf::UINT ||
        channel->xSampling != 1 || channel->ySampling != 1)
      refuse(path, "channels must be R, G, B and A, float or half, at full resolution");
  }
}

void require_size(const Imf::Header& header, const Grid& grid, const fs::path& path) {
  const Size size = atlas_size(grid);
  const auto& window = header.dataWindow();
  if (window.min.x != 0 || window.min.y != 0 || window.max.x + 1 != static_cast<int>(size.width) ||
      window.max.y + 1 != static_cast<int>(size.height))
    refuse(path, fmt::format("data window is ({}, {}) to ({}, {}); the axes ask for {} x {} pixels",
                             window.min.x, window.min.y, window.max.x, window.max.y, size.width,
                             size.height));
}

// No compression that tables are written with makes 2,000 bytes of values out of one (deflate:
// 1,032 at most): a small file that claims a large image is refused before memory is taken for it.
void require_room_for_pixels(const Grid& grid, std::uintmax_t file_bytes, const fs::path& path) {
  constexpr std::uintmax_t most_per_byte = 2000;
  const std::uintmax_t pixel_bytes = channels_per_file * sizeof(float) * grid.size();
  if (pixel_bytes > most_per_byte * file_bytes)
    refuse(path, fmt::format("{} bytes long; too few for {} pixels", file_bytes, grid.size()));
}

// What the header says of the table, empty of values. Checks all of it against the layout.
Table read_header(const Imf::InputFile& file, std::size_t index, std::uintmax_t file_bytes,
                  const fs::path& path) {
  const Imf::Header& header = file.header();
  if (const int found = attribute<Imf::IntAttribute>(header, "ltc:format_version", path);
      found != version)
    refuse(path, fmt::format("ltc:format_version is {}; allowed: {}", found, version));
  require_channels(header, index, path);
  const Grid grid = read_grid(header, path);
  require_size(header, grid, path);
  require_room_for_pixels(grid, file_bytes, path);
  const auto storage = attribute<Imf::StringAttribute>(header, "ltc:storage", path);
  Table table = Table::empty(grid, value_named<Storage>(storage));
  table.creases = read_creases(header, table, path);
  table.refined = read_refined(header, path);
  table.precision = has_half_channel(header) ? Precision::half : Precision::single;
  return table;
}

std::vector<float> read_pixels(Imf::InputFile& file, const Grid& grid) {
  const Size size = atlas_size(grid);
  constexpr std::size_t pixel_bytes = channels_per_file * sizeof(float);
  std::vector<float> pixels(channels_per_file * size.width * size.height);
  Imf::FrameBuffer buffer;
  for (std::size_t channel = 0; channel < channels_per_file; ++channel)
    buffer.insert(channel_names[channel],
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data() + channel),
                             pixel_bytes, pixel_bytes * size.width));
  file.setFrameBuffer(buffer);
  file.readPixels(0, static_cast<int>(size.height) - 1);
  return pixels;
}

void take_pixels(Table& table, std::size_t index, const std::vector<float>& pixels,
                 const fs::path& path) {
  for (std::size_t entry = 0; entry < table.grid.size(); ++entry) {
    const float* const first = &pixels[channels_per_file * pixel(table.grid, entry)];
    for (std::size_t channel = 0; channel < channels_per_file; ++channel) {
      if (!std::isfinite(first[channel]))
        refuse(path, fmt::format("channel {} is not finite at pixel {}", channel_names[channel],
                                 pixel(table.grid, entry)));
      set_channel_value(table, entry, channels_per_file * index + channel, first[channel]);
    }
  }
}

// Reads file `index` into the table; the first one makes it.
void read_file_into(Table& table, std::size_t index, const fs::path& path) {
  const std::uintmax_t file_bytes = require_readable(path);
  if (const std::string fault = exr_header_fault(path); !fault.empty())
    refuse(path, fault);
  // The largest table's atlas.
  const BoundedExrSize bound(max_nodes_per_axis * max_nodes_per_axis);
  try {
    constexpr int no_threads = 0;
    Imf::InputFile file(path.c_str(), no_threads);
    Table found = read_header(file, index, file_bytes, path);
    const bool half = found.precision == Precision::half;
    if (index == 0)
      table = std::move(found);
    else if (found.grid != table.grid || found.storage != table.storage ||
             found.refined != table.refined)
      refuse(path, "axes, warp, storage, alpha_min or ltc:refined differ from those of file 0");
    else if (found.creases != table.creases)
      refuse(path, "ltc:creases differ from those of file 0");
    if (half)
      table.precision = Precision::half;
    take_pixels(table, index, read_pixels(file, table.grid), path);
  } catch (const InputError& error) {
    // Names of warps and storages are refused by those who know them, not the file.
    const std::string what = error.what();
    if (what.starts_with(path.string()))
      throw;
    refuse(path, what);
  } catch (const std::exception& error) {
    refuse(path, fmt::format("no OpenEXR file, or a damaged one ({})", error.what()));
  }
}

}  // namespace

Table read_exr(const TableFiles& paths, const ReadAs&) {
  Table table;
  for (std::size_t index = 0; index < texels_per_entry; ++index)
    read_file_into(table, index, paths[index]);
  if (paths.size() > texels_per_entry && !is_folded(table))
    refuse(paths.back(), fmt::format("of a folded table, yet {} is of one with storage {}",
                                     paths.front().string(), name_of(table.storage)));
  if (is_folded(table)) {
    const std::string first = paths.front().string();
    read_file_into(
        table, texels_per_entry,
        first.substr(0, first.size() - folded_endings.front().size()) + folded_endings.back());
    require_consistent(table, paths.front());
  }
  table.status.assign(table.grid.size(), Status::fitted);
  return table;
}

}  // namespace ltc
