// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Text helpers: clean UTF-8, lines that fit, and the words around a picture.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "picture/canvas.h"

namespace ltc::picture {

// Height of a line of text over its size.
inline constexpr double line_spacing = 1.45;

// The text with every byte that is not part of valid UTF-8, and every control character, replaced
// by U+FFFD.
std::string clean_utf8(std::string_view text);

// Draws a line of text, smaller than asked for if it would be wider than `width` pixels.
void fitted_text(Canvas& canvas, Point anchor, std::string_view line, TextStyle style,
                 double width);

// What is written above and below a picture; what is empty takes no room.
struct Words {
  std::string title{};
  std::string subtitle{};
  std::vector<std::string> lines_below{};  // captions, parameters
};

// What the words leave of a box.
Box inside_words(Box box, const Words& words, double font_size);

// Draws the words at the top and bottom of a box; returns what they leave of it.
Box draw_words(Canvas& canvas, const Box& box, const Words& words, double font_size);

}  // namespace ltc::picture
