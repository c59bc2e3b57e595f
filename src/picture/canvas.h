// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A picture in memory: lines, areas, fields of values and text are drawn into it, and it becomes a
// PNG. Coordinates are those of geometry.h.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "picture/color.h"
#include "picture/geometry.h"
#include "picture/scale.h"

namespace ltc::picture {

// A grid of values, row by row from the top, each row from the left. NaN where there is no value.
struct Field {
  std::size_t width = 0, height = 0;
  std::vector<float> values;  // width * height of them

  float at(std::size_t row, std::size_t column) const { return values[row * width + column]; }
};

enum class Sampling {
  nearest,  // every cell a rectangle of one colour
  linear,   // values (not colours) interpolated between cell centres
};

struct Stroke {
  Color color = ink;
  double width = 1;              // pixels
  std::vector<double> dashes{};  // lengths of dashes and gaps in turn, pixels; empty is solid
};

enum class HorizontalAnchor { left, center, right };
enum class VerticalAnchor { top, middle, baseline, bottom };

struct TextStyle {
  double size = 20;  // pixels from baseline to baseline, roughly
  Color color = ink;
  HorizontalAnchor horizontal = HorizontalAnchor::left;  // which point of the text is placed
  VerticalAnchor vertical = VerticalAnchor::baseline;
  bool bold = false;
  double rotation_degrees = 0;  // counter-clockwise about the anchor
};

class Canvas {
 public:
  // Width and height in pixels, 1 to 16384 each, else InputError.
  Canvas(int width, int height, Color background = white);
  Canvas(Canvas&&) noexcept;
  Canvas& operator=(Canvas&&) noexcept;
  ~Canvas();

  int width() const;
  int height() const;
  Box area() const;  // the whole picture

  void line(Point from, Point to, const Stroke& stroke);
  void polyline(std::span<const Point> points, const Stroke& stroke);
  void polygon(std::span<const Point> corners, Color fill);
  void rectangle(const Box& box, Color fill);
  void outline(const Box& box, const Stroke& stroke);
  void disc(Point center, double radius, Color fill);
  void circle(Point center, double radius, const Stroke& stroke);
  // Diagonal lines over a box, as for cells without a value.
  void hatch(const Box& box, Color color, double spacing = 6);

  // Fills a box, rounded to whole pixels, with the colours of a field. Throws InputError if the
  // field's size and number of values disagree or are zero.
  void image(const Field& field, const ColorScale& colors, const Box& box,
             Sampling sampling = Sampling::nearest);

  // Draws one line of UTF-8 text with its anchor at a point. Bytes that are no UTF-8 show as the
  // replacement character.
  void text(Point anchor, std::string_view line, const TextStyle& style);
  // The box that `text` fills, from ascent to descent whatever the letters.
  Box text_box(Point anchor, std::string_view line, const TextStyle& style) const;
  double text_width(std::string_view line, const TextStyle& style) const;

  // Lets `draw` draw inside a box alone.
  void clipped(const Box& box, const std::function<void()>& draw);

  // The colour of a pixel, 8 bits a channel. Throws InputError outside the picture.
  Color pixel(int x, int y) const;

  // The picture as a PNG file's content, 8-bit RGB; equal pictures give equal bytes.
  std::string png_bytes() const;
  // Writes it beside and renames it; throws IoError naming the file and the reason.
  void write_png(const std::filesystem::path& path) const;

 private:
  struct Cairo;
  std::unique_ptr<Cairo> cairo_;
};

}  // namespace ltc::picture
