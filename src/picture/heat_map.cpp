// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "picture/heat_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "picture/color_bar.h"
#include "picture/label_placement.h"

namespace ltc::picture {
namespace {

constexpr double wanted_map_side = 880;
constexpr double smallest_cell = 2, largest_cell = 40;

// Sizes in units of the font size.
constexpr double margin = 1;
constexpr double label_gap = 0.4;
constexpr double side_gap = 1.5;  // between the map and what stands to its right
constexpr double key_height = 5.5;
constexpr double least_bar_height = 12;
constexpr double header_width = 30;  // what a title needs at least

std::array<const MapAxis*, 4> axes_of(const TiledMap& map) {
  return {&map.tile_rows, &map.tile_columns, &map.rows, &map.columns};
}

void check(const TiledMap& map) {
  std::size_t count = 1;
  for (const MapAxis* axis : axes_of(map)) {
    count *= axis->size;
    if (!axis->labels.empty() && axis->labels.size() != axis->size)
      throw InputError(fmt::format("map axis {} of size {} with {} labels", axis->title, axis->size,
                                   axis->labels.size()));
  }
  if (count == 0 || map.values.size() != count)
    throw InputError(fmt::format("map of {} x {} tiles of {} x {} cells with {} values",
                                 map.tile_rows.size, map.tile_columns.size, map.rows.size,
                                 map.columns.size, map.values.size()));
  for (const CellMark& mark : map.marks)
    for (std::size_t i = 0; i < 4; ++i)
      if (mark.index[i] >= axes_of(map)[i]->size)
        throw InputError(fmt::format("mark at ({}) outside the map", fmt::join(mark.index, ", ")));
}

std::string label_of(const MapAxis& axis, std::size_t index) {
  return axis.labels.empty() ? std::to_string(index) : axis.labels[index];
}

double widest_label(const Canvas& canvas, const MapAxis& axis, double font_size) {
  double widest = 0;
  for (std::size_t i = 0; i < axis.size; ++i)
    widest = std::max(widest, canvas.text_width(label_of(axis, i), {.size = font_size}));
  return widest;
}

double cell_side(const TiledMap& map) {
  const std::size_t cells =
      std::max(map.tile_rows.size * map.rows.size, map.tile_columns.size * map.columns.size);
  return std::clamp(std::floor(wanted_map_side / static_cast<double>(cells)), smallest_cell,
                    largest_cell);
}

double side_of(std::size_t tiles, std::size_t cells, double cell, double gap) {
  const double n = static_cast<double>(tiles);
  return n * static_cast<double>(cells) * cell + (n - 1) * gap;
}

// The values of one tile.
Field tile_field(const TiledMap& map, std::size_t tile_row, std::size_t tile_column) {
  const std::size_t cells = map.rows.size * map.columns.size;
  const auto begin =
      map.values.begin() +
      static_cast<std::ptrdiff_t>((tile_row * map.tile_columns.size + tile_column) * cells);
  return {map.columns.size, map.rows.size, {begin, begin + static_cast<std::ptrdiff_t>(cells)}};
}

template <typename Visit>
void for_each_tile(const TiledMap& map, const Visit& visit) {
  for (std::size_t row = 0; row < map.tile_rows.size; ++row)
    for (std::size_t column = 0; column < map.tile_columns.size; ++column)
      visit(row, column);
}

void draw_tiles(Canvas& canvas, const TiledMap& map, const TiledMapLayout& layout) {
  for_each_tile(map, [&](std::size_t tile_row, std::size_t tile_column) {
    const Field field = tile_field(map, tile_row, tile_column);
    const Box box = layout.tile_box(tile_row, tile_column);
    canvas.image(field, map.colors, box);
    for (std::size_t i = 0; i < field.values.size(); ++i)
      if (std::isnan(field.values[i]))
        canvas.hatch(layout.cell_box({tile_row, tile_column, i / field.width, i % field.width}),
                     faint_ink, 5);
    canvas.outline(box.inset(-0.5), {faint_ink, 1});
  });
}

// Draws every label of an axis, or every second, third …: as many as do not touch each other.
void draw_labels_along(Canvas& canvas, const MapAxis& axis, const TextStyle& style,
                       const auto& anchor_of) {
  // Words beside each other need more than a hair's breadth between them.
  const double spare = 0.4 * style.size;
  const auto touch = [&](std::size_t stride) {
    for (std::size_t i = stride; i < axis.size; i += stride) {
      const Box before = canvas.text_box(anchor_of(i - stride), label_of(axis, i - stride), style);
      const Box box = canvas.text_box(anchor_of(i), label_of(axis, i), style);
      if (before.overlaps({box.left - spare, box.top, box.width + spare, box.height}))
        return true;
    }
    return false;
  };
  std::size_t stride = 1;
  while (touch(stride))
    ++stride;
  for (std::size_t i = 0; i < axis.size; i += stride)
    canvas.text(anchor_of(i), label_of(axis, i), style);
}

void draw_tile_labels(Canvas& canvas, const TiledMap& map, const TiledMapLayout& layout) {
  const double f = map.font_size, gap = label_gap * f;
  TextStyle style{
      .size = f, .horizontal = HorizontalAnchor::right, .vertical = VerticalAnchor::middle};
  draw_labels_along(canvas, map.tile_rows, style, [&](std::size_t i) {
    return Point{layout.map.left - gap, layout.tile_box(i, 0).center().y};
  });
  style.horizontal = HorizontalAnchor::center;
  style.vertical = VerticalAnchor::top;
  draw_labels_along(canvas, map.tile_columns, style, [&](std::size_t i) {
    return Point{layout.tile_box(0, i).center().x, layout.map.bottom() + gap};
  });
  style.bold = true;
  fitted_text(canvas, {layout.map.center().x, layout.map.bottom() + gap + line_spacing * f},
              map.tile_columns.title, style, layout.map.width);
  // A letter stands upright, words are read upwards.
  const bool is_letter = canvas.text_width(map.tile_rows.title, style) <= f;
  style.rotation_degrees = is_letter ? 0 : 90;
  style.horizontal = is_letter ? HorizontalAnchor::left : HorizontalAnchor::center;
  fitted_text(canvas, {margin * f, layout.map.center().y}, map.tile_rows.title, style,
              layout.map.height);
}

// "θ 0° to 90°".
std::string span_text(const MapAxis& axis) {
  return fmt::format("{} {} to {}", axis.title, label_of(axis, 0), label_of(axis, axis.size - 1));
}

std::vector<std::string> key_lines(const TiledMap& map) {
  std::vector<std::string> lines{"within a tile", "→ " + span_text(map.columns),
                                 "↓ " + span_text(map.rows)};
  if (std::any_of(map.values.begin(), map.values.end(), [](float v) { return std::isnan(v); }))
    lines.emplace_back("hatched: no value");
  return lines;
}

double key_width(const Canvas& canvas, const TiledMap& map) {
  double width = 0;
  for (const std::string& line : key_lines(map))
    width = std::max(width, canvas.text_width(line, {.size = map.font_size}));
  return width;
}

void draw_key(Canvas& canvas, const TiledMap& map, const TiledMapLayout& layout) {
  TextStyle style{.size = map.font_size, .color = faint_ink, .vertical = VerticalAnchor::top};
  Point at{layout.key.left, layout.key.top};
  for (const std::string& line : key_lines(map)) {
    canvas.text(at, line, style);
    at.y += line_spacing * map.font_size;
    style.color = ink;
  }
}

void draw_marks(Canvas& canvas, const TiledMap& map, const TiledMapLayout& layout) {
  const double radius = std::max(0.75 * layout.cell, 6.0);
  const TextStyle style{.size = 0.9 * map.font_size, .vertical = VerticalAnchor::top, .bold = true};
  std::vector<LabelRequest> requests;
  std::vector<Box> rings;
  for (const CellMark& mark : map.marks) {
    const Point center = layout.cell_box(mark.index).center();
    canvas.circle(center, radius, {white, 5});
    canvas.circle(center, radius, {ink, 2.2});
    const Box text = canvas.text_box({0, 0}, mark.label, style);
    if (!mark.label.empty())
      requests.push_back({center, text.width + 6, text.height});
    rings.push_back({center.x - radius, center.y - radius, 2 * radius, 2 * radius});
  }
  const auto places = place_labels(requests, radius + 4, layout.map, rings, {});
  std::size_t next = 0;
  for (const CellMark& mark : map.marks) {
    if (mark.label.empty() || !places[next++])
      continue;
    const LabelPlace& place = *places[next - 1];
    if (place.leader_end)
      canvas.line(requests[next - 1].anchor, *place.leader_end, {ink, 1.5});
    canvas.rectangle(place.box, white);
    canvas.text({place.box.left + 3, place.box.top}, mark.label, style);
  }
}

}  // namespace

ColorScale ratio_colors(double largest, std::string title) {
  if (!(largest > 1))
    throw InputError(fmt::format("largest ratio {}: it must be above 1", largest));
  return {Scale::logarithmic(1 / largest, largest), &ColorMap::diverging(), std::move(title)};
}

Box TiledMapLayout::tile_box(std::size_t tile_row, std::size_t tile_column) const {
  const double width = static_cast<double>(sizes[3]) * cell;
  const double height = static_cast<double>(sizes[2]) * cell;
  return {map.left + static_cast<double>(tile_column) * (width + gap),
          map.top + static_cast<double>(tile_row) * (height + gap), width, height};
}

Box TiledMapLayout::cell_box(const std::array<std::size_t, 4>& index) const {
  const Box tile = tile_box(index[0], index[1]);
  return {tile.left + static_cast<double>(index[3]) * cell,
          tile.top + static_cast<double>(index[2]) * cell, cell, cell};
}

TiledMapLayout lay_out(const TiledMap& map) {
  check(map);
  const Canvas ruler(1, 1);
  const double f = map.font_size;
  TiledMapLayout layout;
  layout.sizes = {map.tile_rows.size, map.tile_columns.size, map.rows.size, map.columns.size};
  layout.cell = cell_side(map);
  layout.gap = std::clamp(std::round(0.4 * layout.cell), 3.0, 8.0);
  const double width = side_of(map.tile_columns.size, map.columns.size, layout.cell, layout.gap);
  const double height = side_of(map.tile_rows.size, map.rows.size, layout.cell, layout.gap);

  const Box without_words = inside_words({0, 0, 0, 0}, map.words, f);
  const double heading = without_words.top, caption = -without_words.height - heading;
  layout.map = {std::ceil((margin + line_spacing + 2 * label_gap) * f +
                          widest_label(ruler, map.tile_rows, f)),
                std::ceil(margin * f + heading), width, height};
  const double side_left = layout.map.right() + side_gap * f;
  const double side_height = std::max(height, (least_bar_height + key_height) * f);
  layout.key = {side_left, layout.map.top, key_width(ruler, map), key_height * f};
  layout.bar = {side_left, layout.key.bottom(), 0, side_height - layout.key.height};
  layout.bar.width = upright_bar_width(ruler, map.colors, layout.bar.height, f);

  const double right = std::max({layout.key.right(), layout.bar.right(), header_width * f});
  layout.width = static_cast<int>(std::ceil(right + margin * f));
  const double below_map = (label_gap + 2 * line_spacing) * f;
  layout.height = static_cast<int>(
      std::ceil(layout.map.top + std::max(side_height, height + below_map) + caption + margin * f));
  return layout;
}

Canvas render(const TiledMap& map) {
  const TiledMapLayout layout = lay_out(map);
  Canvas canvas(layout.width, layout.height);
  draw_words(canvas, canvas.area().inset(margin * map.font_size), map.words, map.font_size);
  draw_tiles(canvas, map, layout);
  draw_tile_labels(canvas, map, layout);
  draw_key(canvas, map, layout);
  draw_upright_bar(canvas, layout.bar, map.colors, map.font_size,
                   beyond(map.colors.scale, map.values));
  draw_marks(canvas, map, layout);
  return canvas;
}

}  // namespace ltc::picture
