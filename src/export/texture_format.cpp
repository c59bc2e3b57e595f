// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/texture_format.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "core/read_file.h"
#include "core/write_file.h"
#include "export/consistency.h"
#include "export/isotropic_layout.h"

namespace ltc {
namespace {

// The largest texture of a table in text, and more.
constexpr std::size_t most_bytes = std::size_t{1} << 30;

std::vector<std::string> two_of(const std::string& ending) {
  return {"_1" + ending, "_2" + ending};
}

std::vector<std::string> three_of(const std::string& ending) {
  return {".0" + ending, ".1" + ending, ".2" + ending};
}

std::vector<std::vector<std::string>> sets_of(const Container& container) {
  std::vector<std::vector<std::string>> sets;
  if (container.two_files)
    sets.push_back(two_of(container.endings.front()));
  if (container.three_files)
    sets.push_back(three_of(container.endings.front()));
  sets.push_back(container.endings);
  return sets;
}

std::vector<std::vector<std::string>> named_sets_of(const Container& container) {
  std::vector<std::vector<std::string>> sets;
  for (const NamedLayout& named : container.named)
    sets.push_back(named.endings);
  return sets;
}

std::vector<std::string> set_for(const Container& container, TextureLayout layout) {
  const auto named = std::ranges::find(container.named, layout, &NamedLayout::layout);
  if (named != container.named.end())
    return named->endings;
  const std::size_t images = image_count(layout);
  if (images == 2 && container.two_files)
    return two_of(container.endings.front());
  if (images == 3 && container.three_files)
    return three_of(container.endings.front());
  return container.endings;
}

// Whether each image has a file of its own in such a set.
bool has_file_each(const Container& container, const TableFiles& files) {
  return container.endings.size() == 1 && files.size() > 1;
}

NamedBytes read(const std::filesystem::path& file) {
  return {file, read_whole_file(file, "table", most_bytes)};
}

// A file beside the first may be missing: tables of matrices alone have one texture, and others'
// raw files no description.
std::vector<Image> decode_all(const Container& container, const TableFiles& files) {
  std::vector<NamedBytes> bytes;
  std::error_code ignored;
  for (const std::filesystem::path& file : files)
    if (&file == &files.front() || std::filesystem::exists(file, ignored))
      bytes.push_back(read(file));
  if (!has_file_each(container, files))
    return container.decode(bytes);
  std::vector<Image> images;
  for (const NamedBytes& one : bytes)
    std::ranges::move(container.decode({one}), std::back_inserter(images));
  return images;
}

std::string limits(const Container& container, const Grid& grid, Storage storage,
                   TextureLayout layout) {
  if (!container.encode)
    return "is read only";
  if (container.only && layout != *container.only)
    return fmt::format("holds layout {} only", name_of(*container.only));
  if (container.four_channels && layout == TextureLayout::eight)
    return "has up to four channels a texel, of which layout eight has eight";
  return why_not(layout, grid, storage);
}

void add(const Container& container, platform::FileSet& set, const Table& table,
         const TableFiles& files, const WriteOptions& options) {
  const IsotropicLayout* const isotropic = isotropic_layout(options.layout);
  if (!isotropic || isotropic->amplitude != IsotropicLayout::none)
    require_albedo(table, files.front());
  std::vector<Image> images = images_of(table, options.layout);
  for (Image& image : images)
    image.precision = options.half ? Precision::half : Precision::single;
  std::vector<std::string> bytes;
  if (has_file_each(container, files))
    for (std::size_t i = 0; i < files.size(); ++i)
      bytes.push_back(container.encode({images[i]}, {files[i]}, options).front());
  else
    bytes = container.encode(images, files, options);
  for (std::size_t i = 0; i < files.size(); ++i)
    add_file(set, files[i], bytes[i]);
}

}  // namespace

Format texture_format(const Container& container) {
  return {.name = container.name,
          .sets = sets_of(container),
          .asked = container.asked,
          .contents = {.albedo = true, .loss = false},
          .entry_bytes = 12 * sizeof(float),
          .half = container.half,
          .ending_of_others = container.ending_of_others,
          .named_sets = named_sets_of(container),
          .set_for = [container](TextureLayout layout) { return set_for(container, layout); },
          .limits = [container](
                        const Grid& grid, Storage storage,
                        TextureLayout layout) { return limits(container, grid, storage, layout); },
          .read =
              [container](const TableFiles& files, const ReadAs& as) {
                return table_of(decode_all(container, files), as.textures, files.front(), as.model);
              },
          .add = container.encode ? std::bind_front(add, container) : decltype(Format::add)()};
}

}  // namespace ltc
