// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "picture/panel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "picture/color_bar.h"

namespace ltc::picture {
namespace {

// Sizes in units of the font size.
constexpr double panel_gap = 1.2;
constexpr double bar_gap = 0.7;  // between panels and colour bars
constexpr double margin = 1;

void check(const PanelRow& row) {
  if (row.panels.empty())
    throw InputError("a row of panels without a panel");
  for (const Panel& panel : row.panels)
    if (panel.scale >= row.scales.size())
      throw InputError(fmt::format("panel {} with colour scale {} of {}", panel.title, panel.scale,
                                   row.scales.size()));
}

// All that stands above and below the squares.
double height_around_squares(const PanelRow& row) {
  const double f = row.font_size;
  return -inside_words({0, 0, 0, 0}, row.words, f).height + (line_spacing + bar_gap) * f +
         lying_bar_height(f);
}

double side_for_width(const PanelRow& row, double width) {
  const double n = static_cast<double>(row.panels.size());
  return std::floor((width - (n - 1) * panel_gap * row.font_size) / n);
}

// The colour bar of a scale spans the panels that use it.
Box bar_below(const PanelRow& row, std::span<const Box> panels, std::size_t scale) {
  double left = 0, right = 0;
  bool used = false;
  for (std::size_t i = 0; i < panels.size(); ++i)
    if (row.panels[i].scale == scale) {
      left = used ? left : panels[i].left;
      right = panels[i].right();
      used = true;
    }
  const double top = panels.front().bottom() + bar_gap * row.font_size;
  return used ? Box{left, top, right - left, lying_bar_height(row.font_size)} : Box{};
}

Beyond outside_scale(const PanelRow& row, std::size_t scale) {
  Beyond outside;
  for (const Panel& panel : row.panels)
    if (panel.scale == scale)
      outside = outside | beyond(row.scales[scale].scale, panel.field.values);
  return outside;
}

void draw_overlay(Canvas& canvas, const Box& box, const Overlay& overlay, double font_size) {
  std::vector<Point> points;
  for (const Point& point : overlay.points)
    points.push_back({box.left + point.x * box.width, box.top + point.y * box.height});
  canvas.clipped(box, [&] {
    canvas.polyline(points, overlay.stroke);
    if (!points.empty())
      canvas.text({points.back().x + 0.25 * font_size, points.back().y}, overlay.label,
                  {.size = 0.8 * font_size,
                   .color = overlay.stroke.color,
                   .vertical = VerticalAnchor::middle});
  });
}

}  // namespace

double height_for_width(const PanelRow& row, double width) {
  return height_around_squares(row) + side_for_width(row, width);
}

PanelLayout lay_out(const PanelRow& row, const Box& box) {
  check(row);
  const double f = row.font_size;
  const double side =
      std::min(side_for_width(row, box.width), std::floor(box.height - height_around_squares(row)));
  const double top = std::round(inside_words(box, row.words, f).top + line_spacing * f);
  PanelLayout layout;
  for (std::size_t i = 0; i < row.panels.size(); ++i)
    layout.panels.push_back(
        {std::round(box.left + static_cast<double>(i) * (side + panel_gap * f)), top, side, side});
  for (std::size_t i = 0; i < row.scales.size(); ++i)
    layout.bars.push_back(bar_below(row, layout.panels, i));
  return layout;
}

void draw(Canvas& canvas, const Box& box, const PanelRow& row) {
  const PanelLayout layout = lay_out(row, box);
  const double f = row.font_size;
  draw_words(canvas, box, row.words, f);
  for (std::size_t i = 0; i < row.panels.size(); ++i) {
    const Panel& panel = row.panels[i];
    const Box& square = layout.panels[i];
    fitted_text(canvas, {square.center().x, square.top - 0.7 * f}, panel.title,
                {.size = f,
                 .horizontal = HorizontalAnchor::center,
                 .vertical = VerticalAnchor::middle,
                 .bold = true},
                square.width);
    canvas.image(panel.field, row.scales[panel.scale], square, row.sampling);
    for (const Overlay& overlay : row.overlays)
      draw_overlay(canvas, square, overlay, f);
    canvas.outline(square.inset(-0.5), {faint_ink, 1});
  }
  for (std::size_t i = 0; i < row.scales.size(); ++i)
    if (layout.bars[i].width > 0)
      draw_lying_bar(canvas, layout.bars[i], row.scales[i], f, outside_scale(row, i));
}

Canvas render(const PanelRow& row, int width) {
  check(row);
  const double edge = margin * row.font_size;
  const double height = height_for_width(row, width - 2 * edge) + 2 * edge;
  Canvas canvas(width, static_cast<int>(std::ceil(height)));
  draw(canvas, canvas.area().inset(edge), row);
  return canvas;
}

}  // namespace ltc::picture
