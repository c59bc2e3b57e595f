// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "picture/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ltc::picture {
namespace {

// Sizes in units of the font size.
constexpr double tick_gap = 0.35;  // between the plot and the labels of its ticks
constexpr double marker_radius = 0.36;
constexpr double label_clearance = 0.6;  // from a point to its label
constexpr double legend_swatch = 1.6;
constexpr double legend_gap = 0.4;
constexpr double x_tick_distance = 4.5;
constexpr double y_tick_distance = 2.4;
constexpr double label_scale = 0.85;

bool is_shown(const ChartLayout& layout, Point at) {
  // Points on the frame are in, whatever rounding says.
  return layout.plot.inset(-0.5).contains(at);
}

Scale fit_axis(const Chart& chart, Guide::Axis which) {
  const ChartAxis& axis = which == Guide::Axis::x ? chart.x : chart.y;
  if (axis.scale)
    return *axis.scale;
  std::vector<double> values;
  for (const Series& series : chart.series)
    for (const ChartPoint& point : series.points)
      values.push_back(which == Guide::Axis::x ? point.x : point.y);
  for (const Guide& guide : chart.guides)
    if (guide.axis == which)
      values.push_back(guide.value);
  return Scale::around(values, axis.kind);
}

std::size_t tick_count(double length, double distance) {
  return static_cast<std::size_t>(std::max(2.0, length / distance));
}

double widest(const Canvas& canvas, std::span<const Tick> ticks, double font_size) {
  double width = 0;
  for (const Tick& tick : ticks)
    width = std::max(width, canvas.text_width(tick.label, {.size = font_size}));
  return width;
}

// One entry of the legend and where its swatch begins.
struct LegendEntry {
  const Series* series;
  Point at;
};

// The legend in rows at the top of a box, from which it takes their height.
std::vector<LegendEntry> take_legend(const Chart& chart, const Canvas& canvas, Box& box) {
  const double row = line_spacing * chart.font_size;
  std::vector<LegendEntry> entries;
  double x = box.left;
  double rows = 0;
  for (const Series& series : chart.series) {
    if (series.name.empty())
      continue;
    const double width = canvas.text_width(series.name, {.size = chart.font_size}) +
                         (legend_swatch + legend_gap) * chart.font_size;
    if (rows == 0 || x + width > box.right()) {
      x = box.left;
      ++rows;
    }
    entries.push_back({&series, {x, box.top + (rows - 0.5) * row}});
    x += width + 3 * legend_gap * chart.font_size;
  }
  box.take_top(rows * row);
  return entries;
}

// What a chart's box is divided into.
struct Parts {
  std::vector<LegendEntry> legend;
  Box y_title;
  Box plot;
};

Parts divide(const Chart& chart, const Canvas& canvas, const Box& box, double left_margin,
             double right_margin) {
  const double f = chart.font_size;
  Box rest = inside_words(box, chart.words, f);
  Parts parts;
  parts.legend = take_legend(chart, canvas, rest);
  if (!parts.legend.empty())
    rest.take_top(legend_gap * f);
  parts.y_title = rest.take_top((chart.y.title.empty() ? 0.6 : line_spacing + tick_gap) * f);
  rest.take_bottom((line_spacing + tick_gap) * f);
  if (!chart.x.title.empty())
    rest.take_bottom(line_spacing * f);
  rest.take_left(left_margin);
  rest.take_right(right_margin);
  // Whole pixels keep the frame sharp.
  parts.plot = {std::round(rest.left) + 0.5, std::round(rest.top) + 0.5, std::round(rest.width),
                std::round(rest.height)};
  return parts;
}

Parts divide(const Chart& chart, const Canvas& canvas, const Box& box, const ChartLayout& layout) {
  const double f = chart.font_size;
  const double last_label =
      layout.x_ticks.empty() ? 0 : canvas.text_width(layout.x_ticks.back().label, {.size = f});
  return divide(chart, canvas, box, widest(canvas, layout.y_ticks, f) + tick_gap * f,
                std::max(last_label / 2, 0.5 * f));
}

Box square_around(Point center, double half_side) {
  return {center.x - half_side, center.y - half_side, 2 * half_side, 2 * half_side};
}

TextStyle label_style(const Chart& chart) {
  return {.size = label_scale * chart.font_size, .vertical = VerticalAnchor::top};
}

Segment guide_line(const ChartLayout& layout, const Guide& guide) {
  const Box& plot = layout.plot;
  const bool upright = guide.axis == Guide::Axis::x;
  const double x = plot.left + layout.x.position(guide.value) * plot.width;
  const double y = plot.bottom() - layout.y.position(guide.value) * plot.height;
  return upright ? Segment{{x, plot.bottom()}, {x, plot.top}}
                 : Segment{{plot.left, y}, {plot.right(), y}};
}

// The words on a guide stand at its end, on its left or upper side.
struct GuideLabel {
  Point anchor;
  TextStyle style;
};

GuideLabel guide_label(const Chart& chart, const ChartLayout& layout, const Guide& guide) {
  const double gap = 0.25 * chart.font_size;
  const Point end = guide_line(layout, guide).to;
  TextStyle style{.size = label_scale * chart.font_size,
                  .color = faint_ink,
                  .horizontal = HorizontalAnchor::right,
                  .vertical = VerticalAnchor::bottom};
  if (guide.axis == Guide::Axis::y)
    return {{end.x - gap, end.y - gap / 2}, style};
  style.rotation_degrees = 90;
  return {{end.x - gap / 2, end.y + gap}, style};
}

void collect_lines(const Chart& chart, const ChartLayout& layout, std::vector<Segment>& lines) {
  for (const Series& series : chart.series)
    for (std::size_t i = 1; i < series.points.size() && series.line_width > 0; ++i) {
      const Point from = layout.at(series.points[i - 1].x, series.points[i - 1].y);
      const Point to = layout.at(series.points[i].x, series.points[i].y);
      if (is_shown(layout, from) || is_shown(layout, to))
        lines.push_back({from, to});
    }
  for (const Guide& guide : chart.guides)
    lines.push_back(guide_line(layout, guide));
}

void place_point_labels(const Chart& chart, const Canvas& canvas, ChartLayout& layout) {
  const double f = chart.font_size;
  std::vector<LabelRequest> requests;
  std::vector<Box> obstacles;
  std::vector<ChartLayout::Label> labels;
  for (const Series& series : chart.series)
    for (const ChartPoint& point : series.points) {
      const Point at = layout.at(point.x, point.y);
      if (!is_shown(layout, at))
        continue;
      if (series.marker != Marker::none)
        obstacles.push_back(square_around(at, marker_radius * f));
      if (point.label.empty())
        continue;
      const Box box = canvas.text_box({0, 0}, point.label, label_style(chart));
      requests.push_back({at, box.width, box.height});
      labels.push_back({point.label, at, {}});
    }
  for (const Guide& guide : chart.guides)
    if (!guide.label.empty()) {
      const GuideLabel label = guide_label(chart, layout, guide);
      obstacles.push_back(canvas.text_box(label.anchor, guide.label, label.style));
    }
  std::vector<Segment> lines;
  collect_lines(chart, layout, lines);

  const auto places = place_labels(requests, label_clearance * f, layout.plot, obstacles, lines);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i]) {
      labels[i].place = *places[i];
      layout.labels.push_back(labels[i]);
    }
  layout.labels_without_room = labels.size() - layout.labels.size();
}

// About a point, its tip up.
std::array<Point, 3> triangle(Point at, double radius) {
  return {{{at.x, at.y - radius},
           {at.x + 0.9 * radius, at.y + 0.7 * radius},
           {at.x - 0.9 * radius, at.y + 0.7 * radius}}};
}

void draw_marker(Canvas& canvas, Marker marker, Point at, double radius, Color color) {
  // A white rim keeps markers apart where they touch.
  const Stroke rim{white, 0.2 * radius};
  const auto shape = [&](std::span<const Point> corners) { canvas.polygon(corners, color); };
  const double x = at.x, y = at.y;
  switch (marker) {
    case Marker::none:
      return;
    case Marker::disc:
      canvas.disc(at, radius, color);
      canvas.circle(at, radius, rim);
      return;
    case Marker::square:
      canvas.rectangle(square_around(at, 0.88 * radius), color);
      return;
    case Marker::diamond: {
      const double r = 1.25 * radius;
      return shape(std::array<Point, 4>{{{x - r, y}, {x, y - r}, {x + r, y}, {x, y + r}}});
    }
    case Marker::triangle:
      return shape(triangle(at, 1.2 * radius));
    case Marker::open_triangle: {
      const auto [a, b, c] = triangle(at, 1.8 * radius);
      // Once around and along the first side again, for its corner to be joined as well.
      return canvas.polyline(std::array<Point, 5>{a, b, c, a, b}, {color, 0.4 * radius});
    }
  }
}

void draw_grid(Canvas& canvas, const ChartLayout& layout) {
  const Box& plot = layout.plot;
  const auto stroke = [](const Tick& tick) {
    return Stroke{grid_ink, tick.label.empty() ? 0.6 : 1.4};
  };
  for (const Tick& tick : layout.x_ticks) {
    const double x = plot.left + layout.x.position(tick.value) * plot.width;
    canvas.line({x, plot.top}, {x, plot.bottom()}, stroke(tick));
  }
  for (const Tick& tick : layout.y_ticks) {
    const double y = plot.bottom() - layout.y.position(tick.value) * plot.height;
    canvas.line({plot.left, y}, {plot.right(), y}, stroke(tick));
  }
  canvas.outline(plot, {faint_ink, 1});
}

void draw_axes(Canvas& canvas, const Chart& chart, const ChartLayout& layout, const Box& y_title) {
  const Box& plot = layout.plot;
  const double f = chart.font_size, gap = tick_gap * f;
  TextStyle style{
      .size = f, .horizontal = HorizontalAnchor::center, .vertical = VerticalAnchor::top};
  for (const Tick& tick : layout.x_ticks)
    canvas.text({plot.left + layout.x.position(tick.value) * plot.width, plot.bottom() + gap},
                tick.label, style);
  fitted_text(canvas, {plot.center().x, plot.bottom() + gap + line_spacing * f}, chart.x.title,
              style, plot.width);
  style.horizontal = HorizontalAnchor::right;
  style.vertical = VerticalAnchor::middle;
  for (const Tick& tick : layout.y_ticks)
    canvas.text({plot.left - gap, plot.bottom() - layout.y.position(tick.value) * plot.height},
                tick.label, style);
  style.horizontal = HorizontalAnchor::left;
  style.vertical = VerticalAnchor::top;
  fitted_text(canvas, {y_title.left, y_title.top}, chart.y.title, style, y_title.width);
}

void draw_series(Canvas& canvas, const Chart& chart, const ChartLayout& layout,
                 const Series& series) {
  std::vector<Point> run;
  const auto finish_run = [&] {
    if (run.size() > 1)
      canvas.polyline(run, {series.color, series.line_width, series.dashes});
    run.clear();
  };
  std::vector<Point> markers;
  for (const ChartPoint& point : series.points) {
    const Point at = layout.at(point.x, point.y);
    if (!std::isfinite(at.x) || !std::isfinite(at.y)) {
      finish_run();
      continue;
    }
    if (series.line_width > 0)
      run.push_back(at);
    if (is_shown(layout, at))
      markers.push_back(at);
  }
  canvas.clipped(layout.plot, finish_run);
  for (const Point& at : markers)
    draw_marker(canvas, series.marker, at, marker_radius * chart.font_size, series.color);
}

void draw_guides(Canvas& canvas, const Chart& chart, const ChartLayout& layout) {
  for (const Guide& guide : chart.guides) {
    const Segment line = guide_line(layout, guide);
    if (!is_shown(layout, line.from))
      continue;
    canvas.line(line.from, line.to,
                {faint_ink, 1.5, {0.4 * chart.font_size, 0.3 * chart.font_size}});
    const GuideLabel label = guide_label(chart, layout, guide);
    canvas.text(label.anchor, guide.label, label.style);
  }
}

void draw_labels(Canvas& canvas, const Chart& chart, const ChartLayout& layout) {
  for (const ChartLayout::Label& label : layout.labels)
    if (label.place.leader_end)
      canvas.line(label.anchor, *label.place.leader_end, {faint_ink, 1});
  for (const ChartLayout::Label& label : layout.labels)
    canvas.text({label.place.box.left, label.place.box.top}, label.text, label_style(chart));
}

void draw_legend(Canvas& canvas, const Chart& chart, std::span<const LegendEntry> legend) {
  const double f = chart.font_size, swatch = legend_swatch * f;
  for (const auto& [series, at] : legend) {
    if (series->line_width > 0)
      canvas.line(at, {at.x + swatch, at.y}, {series->color, series->line_width, series->dashes});
    draw_marker(canvas, series->marker, {at.x + swatch / 2, at.y}, marker_radius * f,
                series->color);
    canvas.text({at.x + swatch + legend_gap * f, at.y}, series->name,
                {.size = f, .vertical = VerticalAnchor::middle});
  }
}

}  // namespace

std::vector<ChartPoint> pareto_front(std::span<const ChartPoint> points) {
  std::vector<ChartPoint> front;
  for (const ChartPoint& point : points)
    if (!std::isnan(point.x) && !std::isnan(point.y))
      front.push_back({point.x, point.y});
  std::sort(front.begin(), front.end(), [](const ChartPoint& a, const ChartPoint& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  double least = std::numeric_limits<double>::infinity();
  std::erase_if(front, [&](const ChartPoint& point) {
    const bool beaten = point.y >= least;
    least = std::min(least, point.y);
    return beaten;
  });
  return front;
}

Point ChartLayout::at(double x_value, double y_value) const {
  return {plot.left + x.position(x_value) * plot.width,
          plot.bottom() - y.position(y_value) * plot.height};
}

ChartLayout lay_out(const Chart& chart, const Canvas& canvas, const Box& box) {
  const double f = chart.font_size;
  ChartLayout layout;
  layout.x = fit_axis(chart, Guide::Axis::x);
  layout.y = fit_axis(chart, Guide::Axis::y);
  // The ticks decide the margins and the margins the number of ticks: the height does not depend on
  // either, so the upright axis comes first.
  layout.plot = divide(chart, canvas, box, layout).plot;
  layout.y_ticks =
      layout.y.ticks(chart.y.format, tick_count(layout.plot.height, y_tick_distance * f));
  layout.plot = divide(chart, canvas, box, layout).plot;
  layout.x_ticks =
      layout.x.ticks(chart.x.format, tick_count(layout.plot.width, x_tick_distance * f));
  layout.plot = divide(chart, canvas, box, layout).plot;
  place_point_labels(chart, canvas, layout);
  return layout;
}

void draw(Canvas& canvas, const Box& box, const Chart& chart) {
  const ChartLayout layout = lay_out(chart, canvas, box);
  const Parts parts = divide(chart, canvas, box, layout);
  draw_words(canvas, box, chart.words, chart.font_size);
  draw_legend(canvas, chart, parts.legend);
  draw_grid(canvas, layout);
  draw_axes(canvas, chart, layout, parts.y_title);
  draw_guides(canvas, chart, layout);
  for (const Series& series : chart.series)
    draw_series(canvas, chart, layout, series);
  draw_labels(canvas, chart, layout);
}

Canvas render(const Chart& chart, int width, int height) {
  Canvas canvas(width, height);
  draw(canvas, canvas.area().inset(chart.font_size), chart);
  return canvas;
}

}  // namespace ltc::picture
