// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables as numbers in text: JSON, a JavaScript module, a C header, Unity's C#, and those of
// Octave.
#include <fmt/format.h>

#include <cctype>

#include "core/read_file.h"
#include "export/field_file.h"
#include "export/number_text.h"
#include "export/octave.h"
#include "export/texture_format.h"

namespace ltc {
namespace {

std::vector<Image> decode_lists(const std::vector<NamedBytes>& files) {
  return decode_number_lists(files.front().bytes, files.front().file);
}

// The module of three.js' addons of that name: its textures are made by init().
std::string three_module(const std::vector<Image>& images) {
  const Image& image = images.front();
  return fmt::format(R"(import {{
  ClampToEdgeWrapping, DataTexture, DataUtils, FloatType, HalfFloatType, LinearFilter,
  NearestFilter, RGBAFormat, UVMapping
}} from 'three';

{}
function texture(values, type) {{
  const result = new DataTexture(values, {}, {}, RGBAFormat, type, UVMapping, ClampToEdgeWrapping,
    ClampToEdgeWrapping, LinearFilter, NearestFilter, 1);
  result.needsUpdate = true;
  return result;
}}

const halves = (values) => Uint16Array.from(values, DataUtils.toHalfFloat);

class RectAreaLightTexturesLib {{
  static init() {{
    this.LTC_FLOAT_1 = texture(new Float32Array(LTC_MAT_1), FloatType);
    this.LTC_FLOAT_2 = texture(new Float32Array(LTC_MAT_2), FloatType);
    this.LTC_HALF_1 = texture(halves(LTC_MAT_1), HalfFloatType);
    this.LTC_HALF_2 = texture(halves(LTC_MAT_2), HalfFloatType);
    return this;
  }}
}}

RectAreaLightTexturesLib.LTC_HALF_1 = null;
RectAreaLightTexturesLib.LTC_HALF_2 = null;
RectAreaLightTexturesLib.LTC_FLOAT_1 = null;
RectAreaLightTexturesLib.LTC_FLOAT_2 = null;

export {{ RectAreaLightTexturesLib }};
)",
                     encode_javascript(images, "const"), image.width, image.height);
}

std::string javascript_of(const std::vector<Image>& images, const WriteOptions& options) {
  return options.javascript_style == ScriptStyle::three && options.layout == TextureLayout::ltc
             ? three_module(images)
             : encode_javascript(images);
}

// "LTC_H" of "out/ltc.h".
std::string guard_of(const std::filesystem::path& file) {
  std::string guard = file.filename().string();
  for (char& c : guard)
    c = std::isalnum(static_cast<unsigned char>(c))
            ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
            : '_';
  return std::isdigit(static_cast<unsigned char>(guard.front())) ? "LTC_" + guard : guard;
}

}  // namespace

// Or a field under another name.
Format json_format() {
  Format format = texture_format(
      {.name = "JSON",
       .endings = {".json"},
       .asked = &OutputSettings::json,
       .ending_of_others = true,
       .encode = [](const std::vector<Image>& images, const TableFiles&,
                    const WriteOptions&) { return std::vector{encode_json(images)}; },
       .decode =
           [](const std::vector<NamedBytes>& files) {
             return decode_json(files.front().bytes, files.front().file);
           }});
  format.read = [arrays = format.read](const TableFiles& files, const ReadAs& as) {
    constexpr std::size_t beginning = 64;
    return is_field(read_first_bytes(files.front(), "table", beginning))
               ? field_format().read(files, as)
               : arrays(files, as);
  };
  return format;
}

Format javascript_format() {
  return texture_format(
      {.name = "JavaScript",
       .endings = {".js"},
       .asked = &OutputSettings::javascript,
       .ending_of_others = true,
       .encode =
           [](const std::vector<Image>& images, const TableFiles&, const WriteOptions& options) {
             return std::vector{javascript_of(images, options)};
           },
       .decode = decode_lists});
}

Format c_sharp_format() {
  return texture_format(
      {.name = "C#",
       .endings = {".cs"},
       .asked = &OutputSettings::c_sharp,
       .only = TextureLayout::unity,
       .ending_of_others = true,
       .encode = [](const std::vector<Image>& images, const TableFiles&,
                    const WriteOptions&) { return std::vector{encode_c_sharp(images)}; },
       .decode = decode_lists});
}

// Others', read only.
Format c_source_format(const char* ending) {
  return texture_format(
      {.name = "C", .endings = {ending}, .ending_of_others = true, .decode = decode_lists});
}

Format octave_format() {
  return texture_format({.name = "Octave",
                         .endings = {".mat"},
                         .ending_of_others = true,
                         .decode = [](const std::vector<NamedBytes>& files) {
                           return decode_octave(files.front().bytes, files.front().file);
                         }});
}

Format c_header_format() {
  return texture_format(
      {.name = "C header",
       .endings = {".h"},
       .asked = &OutputSettings::c_header,
       .ending_of_others = true,
       .encode =
           [](const std::vector<Image>& images, const TableFiles& files, const WriteOptions&) {
             return std::vector{encode_c_header(images, guard_of(files.front()))};
           },
       .decode = decode_lists});
}

}  // namespace ltc
