// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "scene/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "core/read_file.h"

namespace ltc {
namespace {

using nlohmann::json;

constexpr std::size_t most_json_bytes = std::size_t{256} << 20;
// Where in a file values are looked for that say how far an animation goes.
constexpr std::uint64_t most_buffer_bytes = std::uint64_t{256} << 20;
constexpr int most_levels = 64;

// Of a file's bytes, fewer where it ends before.
std::string bytes_from(const std::filesystem::path& file, std::string_view kind,
                       std::uint64_t begin, std::uint64_t count) {
  const std::string bytes = read_first_bytes(file, kind, begin + count);
  return begin < bytes.size() ? bytes.substr(begin) : "";
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw InputError(fmt::format("{}: {}", file.string(), what));
}

// ---- The binary form: a header of 12 bytes, then chunks of length, type and data ----

constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
constexpr std::size_t both_headers = header_bytes + chunk_header_bytes;

std::uint32_t little_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return value;
}

// The length that the header states, which the file has.
std::uint32_t stated_length(GltfFile& file, const std::string& head) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file.path, error);
  if (error)
    throw IoError(fmt::format("cannot read scene {}: {}", file.path.string(), error.message()));
  const std::uint32_t length = little_endian(head, 8);
  if (length > size)
    refuse(file.path,
           fmt::format("truncated: its header says {} bytes, the file has {}", length, size));
  if (length < both_headers)
    refuse(file.path, fmt::format("damaged: its header says {} bytes; expected at least the {} of "
                                  "a binary glTF's headers",
                                  length, both_headers));
  if (length < size)
    file.warnings.push_back(
        fmt::format("{}: left out what follows the {} bytes that its header states",
                    file.path.string(), length));
  return length;
}

// Where the second chunk lies, if there is one and it is of bytes; a damaged one is none.
void find_binary_chunk(GltfFile& file, std::uint64_t begin, std::uint64_t length) {
  if (begin + chunk_header_bytes > length)
    return;
  const std::string head = bytes_from(file.path, "scene", begin, chunk_header_bytes);
  if (head.size() < chunk_header_bytes || head.substr(4) != std::string_view("BIN\0", 4))
    return;
  file.binary_begin = begin + chunk_header_bytes;
  file.binary_bytes = std::min<std::uint64_t>(little_endian(head, 0), length - file.binary_begin);
}

// The JSON chunk, which is the first. Nothing is read before the sizes are found to fit.
std::string json_of_binary(GltfFile& file) {
  const std::string head = read_first_bytes(file.path, "scene", both_headers);
  if (head.size() < both_headers)
    refuse(file.path, fmt::format("truncated: {} bytes; expected at least the {} of a binary "
                                  "glTF's headers",
                                  head.size(), both_headers));
  if (!head.starts_with("glTF"))
    refuse(file.path, "does not begin with \"glTF\", as a binary glTF does");
  if (const std::uint32_t version = little_endian(head, 4); version != 2)
    refuse(file.path, fmt::format("binary glTF of version {}; expected version 2", version));
  const std::uint32_t length = stated_length(file, head);
  if (head.substr(header_bytes + 4, 4) != "JSON")
    refuse(file.path, "its first chunk is not of type JSON");
  const std::uint32_t json_bytes = little_endian(head, header_bytes);
  if (json_bytes > length - both_headers)
    refuse(file.path, fmt::format("damaged: its JSON chunk says {} bytes, {} are left in the file",
                                  json_bytes, length - both_headers));
  if (json_bytes > most_json_bytes)
    refuse(file.path,
           fmt::format("{} bytes of JSON; expected at most {}", json_bytes, most_json_bytes));
  find_binary_chunk(file, both_headers + std::uint64_t{json_bytes}, length);
  return bytes_from(file.path, "scene", both_headers, json_bytes);
}

std::string json_text(GltfFile& file) {
  if (file.path.extension() == ".glb" || read_first_bytes(file.path, "scene", 4) == "glTF")
    return json_of_binary(file);
  return read_whole_file(file.path, "scene", most_json_bytes);
}

// ---- JSON ----

// The rest of the file can be large, and nobody asks for it.
constexpr std::array<std::string_view, 8> members_asked_for = {
    "asset",     "materials",   "meshes",  "animations",
    "accessors", "bufferViews", "buffers", "extensionsUsed"};

json parsed_once(const std::filesystem::path& path, const std::string& text) {
  const auto keep = [&](int level, json::parse_event_t event, json& value) {
    if (level >= most_levels &&
        (event == json::parse_event_t::object_start || event == json::parse_event_t::array_start))
      refuse(path, fmt::format("nested deeper than {} levels, which no glTF is", most_levels));
    return !(level == 1 && event == json::parse_event_t::key) ||
           std::find(members_asked_for.begin(), members_asked_for.end(), value) !=
               members_asked_for.end();
  };
  try {
    return json::parse(text, keep);
  } catch (const json::parse_error& error) {
    refuse(path,
           fmt::format("not JSON at byte {} of {}; expected glTF 2.0", error.byte, text.size()));
  }
}

// The text with every number that is too large for a double as a string, and how many there were.
std::pair<std::string, std::size_t> without_infinite_numbers(const std::string& text) {
  std::string result;
  std::size_t count = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t taken = 1;
    if (quoted && text[i] == '\\')
      taken = std::min<std::size_t>(2, text.size() - i);
    else if (text[i] == '"')
      quoted = !quoted;
    else if (!quoted && text[i] >= '0' && text[i] <= '9')
      taken = std::min(text.find_first_not_of("0123456789.eE+-", i), text.size()) - i;
    const std::string piece = text.substr(i, taken);
    if (taken > 2 && !quoted && std::isinf(std::strtod(piece.c_str(), nullptr))) {
      // The sign before it would stand before a string.
      if (result.ends_with('-'))
        result.pop_back();
      result += '"' + piece + "\"";
      ++count;
    } else {
      result += piece;
    }
    i += taken;
  }
  return {result, count};
}

// JSON has no largest number, but its readers have; what nobody reads may be as large as it likes.
json parsed(GltfFile& file, const std::string& text) {
  try {
    return parsed_once(file.path, text);
  } catch (const json::out_of_range&) {
  }
  const auto [bounded, count] = without_infinite_numbers(text);
  file.warnings.push_back(fmt::format("{}: left out {} number{} too large for a double",
                                      file.path.string(), count, count == 1 ? "" : "s"));
  try {
    return parsed_once(file.path, bounded);
  } catch (const json::out_of_range&) {
    refuse(file.path, "not JSON: a number is too large; expected glTF 2.0");
  }
}

void require_version_2(const std::filesystem::path& path, const json& root) {
  if (!root.is_object() || !root.contains("asset"))
    refuse(path, "has no asset.version, which every glTF has; expected glTF 2.0");
  const json* version = member_of(&root["asset"], "version");
  if (!version || !version->is_string() ||
      !version->get_ref<const std::string&>().starts_with("2."))
    refuse(path, fmt::format("asset.version = {}: expected \"2.0\" or another \"2.x\"",
                             short_text(version ? *version : json())));
}

// ---- Buffers ----

// Letters outside of base 64 end it, as "=" does.
std::string decoded_base64(std::string_view text) {
  static constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char letter : text) {
    const std::size_t digit = letters.find(letter);
    if (digit == std::string_view::npos)
      break;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      bytes += static_cast<char>(bits >> bit_count & 255);
    }
  }
  return bytes;
}

std::optional<std::string> bytes_of_uri(const GltfFile& file, const std::string& uri,
                                        std::uint64_t begin, std::uint64_t count) {
  if (uri.starts_with("data:")) {
    static constexpr std::string_view mark = ";base64,";
    const std::size_t at = uri.find(mark);
    if (at == std::string::npos)
      return std::nullopt;
    // Four letters are three bytes; only those around what is asked for.
    const std::string_view text = std::string_view(uri).substr(at + mark.size());
    const std::uint64_t first = begin / 3;
    if (first * 4 > text.size())
      return std::nullopt;
    const std::string bytes = decoded_base64(text.substr(first * 4, (count / 3 + 2) * 4));
    return bytes.size() < begin % 3 ? std::nullopt : std::optional(bytes.substr(begin % 3, count));
  }
  // A device or a pipe would be waited for, and other folders are none of a scene's business.
  const std::filesystem::path name(uri), beside = file.path.parent_path() / name;
  std::error_code ignored;
  if (name.has_parent_path() || !std::filesystem::is_regular_file(beside, ignored))
    return std::nullopt;
  try {
    return bytes_from(beside, "buffer", begin, count);
  } catch (const IoError&) {
    return std::nullopt;  // as one that is not there
  }
}

}  // namespace

GltfFile read_gltf(const std::filesystem::path& path) {
  GltfFile file;
  file.path = path;
  file.root = parsed(file, json_text(file));
  require_version_2(path, file.root);
  return file;
}

std::optional<std::string> buffer_bytes(const GltfFile& file, std::uint64_t buffer,
                                        std::uint64_t begin, std::uint64_t count) {
  const json* const uri = member_of(element_of(member_of(&file.root, "buffers"), buffer), "uri");
  if (begin > most_buffer_bytes || count > most_buffer_bytes - begin)
    return std::nullopt;
  std::optional<std::string> bytes;
  if (uri && uri->is_string())
    bytes = bytes_of_uri(file, uri->get_ref<const std::string&>(), begin, count);
  else if (!uri && buffer == 0 && begin <= file.binary_bytes && count <= file.binary_bytes - begin)
    bytes = bytes_from(file.path, "scene", file.binary_begin + begin, count);
  if (bytes && bytes->size() < count)
    return std::nullopt;
  return bytes;
}

const json* member_of(const json* value, std::string_view key) {
  if (!value || !value->is_object())
    return nullptr;
  const auto member = value->find(key);
  return member == value->end() ? nullptr : &*member;
}

const json* element_of(const json* value, std::optional<std::uint64_t> index) {
  return value && value->is_array() && index && *index < value->size() ? &(*value)[*index]
                                                                       : nullptr;
}

std::optional<std::uint64_t> whole_number(const json* value) {
  if (!value || !value->is_number_unsigned())
    return std::nullopt;
  return value->get<std::uint64_t>();
}

std::string short_text(const json& value) {
  constexpr std::size_t longest = 60;
  if (value.is_object())
    return "an object";
  if (value.is_array())
    return "an array";
  std::string text = value.dump();
  if (text.size() <= longest)
    return text;
  text.resize(longest);
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0x80))
    text.pop_back();  // not in the middle of a character
  return text + "...";
}

}  // namespace ltc
