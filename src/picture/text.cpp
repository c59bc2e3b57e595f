// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "picture/text.h"

#include <cstddef>
#include <cstdint>

namespace ltc::picture {
namespace {

// Bytes of the valid, shortest-form character at the start of `text`; 0 if there is none.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80)
    return lead >= 0x20 && lead != 0x7f ? 1 : 0;
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length)
    return 0;
  std::uint32_t code = lead & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80)
      return 0;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  return surrogate || overlong || code > 0x10ffff ? 0 : length;
}

constexpr double title_scale = 1.3;
constexpr double space_above = 0.4;  // between title and picture, in font sizes
constexpr double space_below = 0.5;

double heading_height(const Words& words, double font_size) {
  if (words.title.empty() && words.subtitle.empty())
    return 0;
  return font_size * (space_above + (words.title.empty() ? 0 : title_scale * line_spacing) +
                      (words.subtitle.empty() ? 0 : line_spacing));
}

double caption_height(const Words& words, double font_size) {
  if (words.lines_below.empty())
    return 0;
  return font_size * (space_below + line_spacing * static_cast<double>(words.lines_below.size()));
}

// One line of text at the top of a box, which it takes from the box.
void take_line(Canvas& canvas, Box& box, const std::string& line, const TextStyle& style) {
  const Box strip = box.take_top(style.size * line_spacing);
  fitted_text(canvas, {strip.left, strip.center().y}, line, style, strip.width);
}

}  // namespace

std::string clean_utf8(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    clean += length > 0 ? text.substr(0, length) : std::string_view("\uFFFD");
    text.remove_prefix(length > 0 ? length : 1);
  }
  return clean;
}

void fitted_text(Canvas& canvas, Point anchor, std::string_view line, TextStyle style,
                 double width) {
  const double natural = canvas.text_width(line, style);
  if (natural > width && width > 0)
    style.size *= width / natural;
  canvas.text(anchor, line, style);
}

Box inside_words(Box box, const Words& words, double font_size) {
  box.take_top(heading_height(words, font_size));
  box.take_bottom(caption_height(words, font_size));
  return box;
}

Box draw_words(Canvas& canvas, const Box& box, const Words& words, double font_size) {
  TextStyle style{
      .size = title_scale * font_size, .vertical = VerticalAnchor::middle, .bold = true};
  Box rest = box;
  if (!words.title.empty())
    take_line(canvas, rest, words.title, style);
  style.size = font_size;
  style.bold = false;
  style.color = faint_ink;
  if (!words.subtitle.empty())
    take_line(canvas, rest, words.subtitle, style);

  const Box inside = inside_words(box, words, font_size);
  rest = {box.left, inside.bottom() + space_below * font_size, box.width, box.height};
  style.color = ink;
  for (const std::string& line : words.lines_below)
    take_line(canvas, rest, line, style);
  return inside;
}

}  // namespace ltc::picture
