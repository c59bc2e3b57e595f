// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/raw_image.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/enum_names.h"
#include "core/error.h"
#include "core/file.h"
#include "export/image_bytes.h"

namespace ltc {

constexpr EnumNames<ImageShape, 3> enum_names(ImageShape) {
  return {
      "shape",
      {{{ImageShape::flat, "flat"}, {ImageShape::array, "array"}, {ImageShape::volume, "volume"}}}};
}

constexpr EnumNames<Precision, 2> enum_names(Precision) {
  return {"precision", {{{Precision::single, "single"}, {Precision::half, "half"}}}};
}

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// A description of thousands of images: larger ones are none.
constexpr std::size_t most_description_bytes = 1 << 20;

void require_images(const std::vector<Image>& images) {
  if (images.empty())
    throw InputError("no images; allowed: one or more");
  for (const Image& image : images)
    require_storable(image);
}

class Description {
 public:
  Description(std::string_view text, const fs::path& file) : file_(file) {
    if (text.size() > most_description_bytes)
      refuse_file(file_,
                  fmt::format("{} bytes long; allowed: {}", text.size(), most_description_bytes));
    const Json json = Json::parse(text, nullptr, false);
    const auto list = json.is_object() ? json.find("images") : json.end();
    if (list == json.end() || !list->is_array() || list->empty())
      refuse_file(file_, "it describes no images; allowed: {\"images\": [...]}, one or more");
    for (const Json& entry : *list)
      images_.push_back(image_of(entry));
  }

  // Of their sizes, without values.
  std::vector<Image> images() && { return std::move(images_); }

 private:
  Image image_of(const Json& entry) const {
    const std::string where = fmt::format("{}: image {}", file_.string(), images_.size());
    Image image;
    image.name = text_at(entry, "name", where);
    const std::string shape = text_at(entry, "shape", where);
    const std::string precision = text_at(entry, "precision", where);
    try {
      image.shape = value_named<ImageShape>(shape);
      image.precision = value_named<Precision>(precision);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", where, on_one_line(error.what())));
    }
    image.width = number_at_key(entry, "width", where);
    image.height = number_at_key(entry, "height", where);
    image.layers = number_at_key(entry, "layers", where);
    image.channels = number_at_key(entry, "channels", where);
    require_size(image, where);
    return image;
  }

  static std::string text_at(const Json& entry, const char* key, const std::string& where) {
    const auto found = entry.is_object() ? entry.find(key) : entry.end();
    if (found == entry.end() || !found->is_string())
      throw InputError(fmt::format("{} has no {}; allowed: a text", where, key));
    return found->get<std::string>();
  }

  static std::size_t number_at_key(const Json& entry, const char* key, const std::string& where) {
    const auto found = entry.find(key);
    if (found == entry.end() || !found->is_number_unsigned())
      throw InputError(fmt::format("{} has no {}; allowed: a whole number", where, key));
    return found->get<std::size_t>();
  }

  const fs::path& file_;
  std::vector<Image> images_;
};

}  // namespace

std::string encode_raw(const std::vector<Image>& images) {
  require_images(images);
  std::string bytes;
  for (const Image& image : images)
    bytes += value_bytes(image);
  return bytes;
}

std::string describe_raw(const std::vector<Image>& images) {
  require_images(images);
  Json list = Json::array();
  for (const Image& image : images)
    list.push_back({{"name", image.name},
                    {"shape", name_of(image.shape)},
                    {"width", image.width},
                    {"height", image.height},
                    {"layers", image.layers},
                    {"channels", image.channels},
                    {"precision", name_of(image.precision)}});
  Json description;
  description["images"] = std::move(list);
  return description.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::vector<Image> decode_raw(std::string_view bytes, std::string_view description,
                              const fs::path& file, const fs::path& description_file) {
  std::vector<Image> images = Description(description, description_file).images();
  std::size_t expected = 0;
  for (const Image& image : images)
    expected += byte_count(image);
  if (bytes.size() != expected)
    refuse_file(file, fmt::format("{} bytes long; {} asks for {}", bytes.size(),
                                  description_file.string(), expected));
  std::size_t begin = 0;
  for (Image& image : images) {
    image.values = values_of(bytes.substr(begin, byte_count(image)), image.precision);
    begin += byte_count(image);
  }
  return images;
}

std::vector<Image> decode_bare(std::string_view bytes, const fs::path& file) {
  const std::string_view mark("\0\0\1\0", 4);  // PlayCanvas' 0 and 1
  const bool marked = bytes.starts_with(mark) && bytes.size() % 16 == mark.size();
  const std::size_t begin = marked ? mark.size() : 0, texel_bytes = marked ? 32 : 16;
  Image image;
  image.width = image.height = static_cast<std::size_t>(
      std::lround(std::sqrt(static_cast<double>((bytes.size() - begin) / texel_bytes))));
  image.channels = marked ? 4 : 8;
  image.precision = marked ? Precision::single : Precision::half;
  std::vector<Image> images(marked ? 2 : 1, image);
  const std::size_t size = byte_count(image);
  if (size == 0 || bytes.size() != begin + images.size() * size)
    refuse_file(file, fmt::format("{} bytes long, and no {}.json beside it says what they are; "
                                  "allowed without: 16 n^2 bytes, a square of eight halfs, or "
                                  "PlayCanvas' two squares of four floats",
                                  bytes.size(), file.filename().string()));
  require_size(image, file.string());
  for (std::size_t i = 0; i < images.size(); ++i)
    images[i].values = values_of(bytes.substr(begin + i * size, size), image.precision);
  return images;
}

}  // namespace ltc
