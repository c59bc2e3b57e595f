// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "picture/color_bar.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "picture/text.h"

namespace ltc::picture {
namespace {

// Sizes in units of the font size.
constexpr double bar_thickness = 1.2;
constexpr double tick_length = 0.3;
constexpr double label_gap = 0.25;
constexpr double upright_tick_distance = 2.2;
constexpr double lying_tick_distance = 4;
constexpr double point_length = 0.9;  // of a pointed end

constexpr std::size_t ramp_steps = 512;

// The colours in order: positions 0 to 1 of the scale, in a row.
Field ramp(std::size_t width, std::size_t height, bool descending) {
  Field field{width, height, std::vector<float>(width * height)};
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const double position =
        (static_cast<double>(i) + 0.5) / static_cast<double>(field.values.size());
    field.values[i] = static_cast<float>(descending ? 1 - position : position);
  }
  return field;
}

ColorScale by_position(const ColorScale& colors) {
  return {.scale = Scale::linear(0, 1), .map = colors.map};
}

std::size_t tick_count(double length, double font_size, double distance) {
  return static_cast<std::size_t>(std::max(2.0, length / (distance * font_size)));
}

// A triangle that continues the bar beyond one of its ends: from the middle of the end towards
// `tip`, with corners at `a` and `b`.
void draw_point(Canvas& canvas, Point a, Point b, Point tip, Color color) {
  canvas.polygon(std::array{a, b, tip}, color);
  canvas.polyline(std::array{a, tip, b}, {ink, 1});
}

double widest_label(const Canvas& canvas, std::span<const Tick> ticks, double font_size) {
  double widest = 0;
  for (const Tick& tick : ticks)
    widest = std::max(widest, canvas.text_width(tick.label, {.size = font_size}));
  return widest;
}

}  // namespace

Beyond beyond(const Scale& scale, std::span<const float> values) {
  // Slack: values a rounding error outside are on the scale for a reader.
  constexpr double slack = 1e-6;
  Beyond outside;
  for (const float value : values) {
    const double position = scale.position(value);
    outside.below |= position < -slack;
    outside.above |= position > 1 + slack;
  }
  return outside;
}

void draw_upright_bar(Canvas& canvas, Box box, const ColorScale& colors, double font_size,
                      Beyond outside) {
  // Half a line of room at both ends for the end ticks, which a pointed end needs too.
  box = {box.left, box.top + point_length * font_size, box.width,
         box.height - 2 * point_length * font_size};
  const Box bar{box.left, box.top, bar_thickness * font_size, box.height};
  canvas.image(ramp(1, ramp_steps, true), by_position(colors), bar);
  canvas.outline(bar, {ink, 1});
  const double reach = point_length * font_size;
  if (outside.above)
    draw_point(canvas, {bar.left, bar.top}, {bar.right(), bar.top},
               {bar.center().x, bar.top - reach}, colors.map->at(1));
  if (outside.below)
    draw_point(canvas, {bar.left, bar.bottom()}, {bar.right(), bar.bottom()},
               {bar.center().x, bar.bottom() + reach}, colors.map->at(0));

  const auto ticks =
      colors.scale.ticks(colors.format, tick_count(bar.height, font_size, upright_tick_distance));
  const double labels_left = bar.right() + (tick_length + label_gap) * font_size;
  for (const Tick& tick : ticks) {
    const double y = bar.bottom() - colors.scale.position(tick.value) * bar.height;
    const double length = (tick.label.empty() ? 0.5 : 1) * tick_length * font_size;
    canvas.line({bar.right(), y}, {bar.right() + length, y}, {ink, 1});
    canvas.text({labels_left, y}, tick.label,
                {.size = font_size, .vertical = VerticalAnchor::middle});
  }
  if (!colors.title.empty())
    fitted_text(canvas,
                {labels_left + widest_label(canvas, ticks, font_size) + label_gap * font_size,
                 bar.center().y},
                colors.title,
                {.size = font_size,
                 .horizontal = HorizontalAnchor::center,
                 .vertical = VerticalAnchor::top,
                 .rotation_degrees = 90},
                box.height);
}

double upright_bar_width(const Canvas& canvas, const ColorScale& colors, double height,
                         double font_size) {
  const auto ticks =
      colors.scale.ticks(colors.format, tick_count(height, font_size, upright_tick_distance));
  return (bar_thickness + tick_length + 2 * label_gap) * font_size +
         widest_label(canvas, ticks, font_size) +
         (colors.title.empty() ? 0 : line_spacing * font_size);
}

void draw_lying_bar(Canvas& canvas, Box box, const ColorScale& colors, double font_size,
                    Beyond outside) {
  const Box title = box.take_top(line_spacing * font_size);
  fitted_text(canvas, title.center(), colors.title,
              {.size = font_size,
               .horizontal = HorizontalAnchor::center,
               .vertical = VerticalAnchor::middle},
              title.width);
  const double reach = point_length * font_size;
  const Box bar{box.left + reach, box.top, box.width - 2 * reach, bar_thickness * font_size};
  canvas.image(ramp(ramp_steps, 1, false), by_position(colors), bar);
  canvas.outline(bar, {ink, 1});
  if (outside.below)
    draw_point(canvas, {bar.left, bar.top}, {bar.left, bar.bottom()},
               {bar.left - reach, bar.center().y}, colors.map->at(0));
  if (outside.above)
    draw_point(canvas, {bar.right(), bar.top}, {bar.right(), bar.bottom()},
               {bar.right() + reach, bar.center().y}, colors.map->at(1));

  for (const Tick& tick :
       colors.scale.ticks(colors.format, tick_count(bar.width, font_size, lying_tick_distance))) {
    const double x = bar.left + colors.scale.position(tick.value) * bar.width;
    const double length = (tick.label.empty() ? 0.5 : 1) * tick_length * font_size;
    canvas.line({x, bar.bottom()}, {x, bar.bottom() + length}, {ink, 1});
    canvas.text({x, bar.bottom() + tick_length * font_size}, tick.label,
                {.size = font_size,
                 .horizontal = HorizontalAnchor::center,
                 .vertical = VerticalAnchor::top});
  }
}

double lying_bar_height(double font_size) {
  return (line_spacing + bar_thickness + tick_length + line_spacing) * font_size;
}

}  // namespace ltc::picture
