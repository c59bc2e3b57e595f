// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "scene/gltf_file.h"

#include <fmt/format.h>

#include <cstdint>

#include "core/error.h"
#include "core/read_file.h"

namespace ltc {
namespace {

using nlohmann::json;

constexpr std::size_t most_json_bytes = std::size_t{256} << 20;
constexpr int most_levels = 64;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw InputError(fmt::format("{}: {}", file.string(), what));
}

// ---- The binary form: a header of 12 bytes, then chunks of length, type and data ----

constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;

std::uint32_t little_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return value;
}

// The JSON chunk, which is the first. Nothing is read before the sizes are found to fit.
std::string json_of_binary(const std::filesystem::path& file) {
  constexpr std::size_t both_headers = header_bytes + chunk_header_bytes;
  const std::string head = read_first_bytes(file, "scene", both_headers);
  if (head.size() < both_headers)
    refuse(file, fmt::format("truncated: {} bytes; expected at least the {} of a binary glTF's "
                             "headers",
                             head.size(), both_headers));
  if (!head.starts_with("glTF"))
    refuse(file, "does not begin with \"glTF\", as a binary glTF does");
  if (const std::uint32_t version = little_endian(head, 4); version != 2)
    refuse(file, fmt::format("binary glTF of version {}; expected version 2", version));
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error)
    throw IoError(fmt::format("cannot read scene {}: {}", file.string(), error.message()));
  const std::uint32_t length = little_endian(head, 8);
  if (length != size)
    refuse(file, fmt::format("{}: its header says {} bytes, the file has {}",
                             size < length ? "truncated" : "damaged", length, size));
  if (head.substr(header_bytes + 4, 4) != "JSON")
    refuse(file, "its first chunk is not of type JSON");
  const std::uint32_t json_bytes = little_endian(head, header_bytes);
  if (json_bytes > length - both_headers)
    refuse(file, fmt::format("damaged: its JSON chunk says {} bytes, {} are left in the file",
                             json_bytes, length - both_headers));
  if (json_bytes > most_json_bytes)
    refuse(file, fmt::format("{} bytes of JSON; expected at most {}", json_bytes, most_json_bytes));
  return read_first_bytes(file, "scene", both_headers + json_bytes).substr(both_headers);
}

std::string json_text(const std::filesystem::path& file) {
  if (file.extension() == ".glb" || read_first_bytes(file, "scene", 4) == "glTF")
    return json_of_binary(file);
  return read_whole_file(file, "scene", most_json_bytes);
}

// ---- JSON ----

json parsed(const std::filesystem::path& file, const std::string& text) {
  const auto keep = [&](int level, json::parse_event_t event, json& value) {
    if (level >= most_levels &&
        (event == json::parse_event_t::object_start || event == json::parse_event_t::array_start))
      refuse(file, fmt::format("nested deeper than {} levels, which no glTF is", most_levels));
    // The rest of the file can be large, and nobody asks for it.
    return !(level == 1 && event == json::parse_event_t::key) || value == "asset" ||
           value == "materials";
  };
  try {
    return json::parse(text, keep);
  } catch (const json::parse_error& error) {
    refuse(file,
           fmt::format("not JSON at byte {} of {}; expected glTF 2.0", error.byte, text.size()));
  } catch (const json::exception&) {
    refuse(file, "not JSON: a number is too large; expected glTF 2.0");
  }
}

void require_version_2(const std::filesystem::path& file, const json& root) {
  if (!root.is_object() || !root.contains("asset"))
    refuse(file, "has no asset.version, which every glTF has; expected glTF 2.0");
  const json& asset = root["asset"];
  const json version = asset.is_object() && asset.contains("version") ? asset["version"] : json();
  if (!version.is_string() || !version.get_ref<const std::string&>().starts_with("2."))
    refuse(file, fmt::format("asset.version = {}: expected \"2.0\" or another \"2.x\"",
                             short_text(version)));
}

}  // namespace

json read_gltf(const std::filesystem::path& file) {
  json root = parsed(file, json_text(file));
  require_version_2(file, root);
  return root;
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
