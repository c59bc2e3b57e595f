// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/image_exr.h"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/write_file.h"

namespace ltc {
namespace {

// The file's bytes. Into memory first: the library does not report what fails when it closes a
// file.
std::string encode(std::span<const ImageLayer> layers, std::span<const ImageAttribute> attributes) {
  const picture::Field& first = *layers.front().image;
  Imf::Header header(static_cast<int>(first.width), static_cast<int>(first.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const ImageAttribute& attribute : attributes)
    header.insert(attribute.name, Imf::StringAttribute(attribute.text));
  Imf::FrameBuffer buffer;
  for (const ImageLayer& layer : layers) {
    header.channels().insert(layer.channel, Imf::Channel(Imf::FLOAT));
    // The library's slices point to non-const bytes for reading's sake; writing leaves them alone.
    char* const base = const_cast<char*>(reinterpret_cast<const char*>(layer.image->values.data()));
    buffer.insert(layer.channel,
                  Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * first.width));
  }
  Imf::StdOSStream stream;
  {
    constexpr int no_threads = 0;
    Imf::OutputFile file(stream, header, no_threads);
    file.setFrameBuffer(buffer);
    file.writePixels(static_cast<int>(first.height));
  }  // the destructor writes the table of line offsets
  return stream.str();
}

}  // namespace

void write_image_exr(std::span<const ImageLayer> layers, std::span<const ImageAttribute> attributes,
                     const std::filesystem::path& path) {
  if (layers.empty())
    throw InputError(fmt::format("{}: an image without a layer", path.string()));
  const picture::Field& first = *layers.front().image;
  for (const ImageLayer& layer : layers)
    if (layer.image->width != first.width || layer.image->height != first.height ||
        layer.image->values.size() != first.width * first.height || layer.image->values.empty())
      throw InputError(fmt::format("{}: layer {} is not of the size {} x {}", path.string(),
                                   layer.channel, first.width, first.height));
  try {
    write_file(path, encode(layers, attributes));
  } catch (const Iex::BaseExc& error) {
    throw IoError(fmt::format("cannot write {}: {}", path.string(), on_one_line(error.what())));
  }
}

}  // namespace ltc
