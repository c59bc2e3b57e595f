// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/hdf5_heap.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace ltc {
namespace {

// Signature, version 1 and three reserved bytes; the collection's size follows in eight bytes.
constexpr std::string_view collection_start("GCOL\x01\x00\x00\x00", 8);
constexpr std::uint64_t collection_header_bytes = 16;
// Index and reference count of two bytes each, four reserved, and the size in eight.
constexpr std::uint64_t object_header_bytes = 16;

std::uint64_t little_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// A collection is a row of objects, each padded to eight bytes, closed by the free space (index 0),
// whose size counts its own header; or by less room than a header takes.
bool can_be_walked(std::string_view collection) {
  collection.remove_prefix(collection_header_bytes);
  while (collection.size() >= object_header_bytes) {
    const std::uint64_t index = little_endian(collection.substr(0, 2));
    const std::uint64_t size = little_endian(collection.substr(8, 8));
    if (index == 0)
      return size == collection.size();
    if (size > collection.size() - object_header_bytes)
      return false;
    const std::uint64_t padded = object_header_bytes + (size + 7) / 8 * 8;
    if (padded > collection.size())
      return false;
    collection.remove_prefix(padded);
  }
  return true;
}

bool read_at(std::ifstream& file, std::uint64_t offset, std::string& bytes) {
  file.clear();
  file.seekg(static_cast<std::streamoff>(offset));
  return static_cast<bool>(file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())));
}

bool collection_is_sound(std::ifstream& file, std::uint64_t offset, std::uint64_t file_bytes) {
  std::string header(collection_header_bytes, '\0');
  if (!read_at(file, offset, header))
    return false;
  const std::uint64_t size = little_endian(std::string_view(header).substr(8));
  if (size < collection_header_bytes || size > file_bytes - offset)
    return false;
  std::string collection(size, '\0');
  return read_at(file, offset, collection) && can_be_walked(collection);
}

}  // namespace

bool global_heaps_are_sound(const std::filesystem::path& path) {
  constexpr std::uint64_t block_bytes = 1 << 20;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file)
    return false;
  const auto file_bytes = static_cast<std::uint64_t>(file.tellg());
  // Blocks overlap, so that no start is cut in two.
  const std::uint64_t step = block_bytes - collection_start.size();
  for (std::uint64_t offset = 0; offset < file_bytes; offset += step) {
    std::string block(std::min(block_bytes, file_bytes - offset), '\0');
    if (!read_at(file, offset, block))
      return false;
    for (std::size_t found = block.find(collection_start); found != std::string::npos;
         found = block.find(collection_start, found + 1))
      if (!collection_is_sound(file, offset + found, file_bytes))
        return false;
  }
  return true;
}

}  // namespace ltc
