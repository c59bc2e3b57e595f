// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Charts of y against x: run time against error, loss against steps.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "picture/canvas.h"
#include "picture/label_placement.h"
#include "picture/text.h"

namespace ltc::picture {

struct ChartPoint {
  double x = 0, y = 0;  // one that an axis cannot show (NaN, <= 0 on a logarithmic one) is left out
  std::string label{};  // written beside the point
};

// The open one lets a marker below it be seen.
enum class Marker { none, disc, square, diamond, triangle, open_triangle };

struct Series {
  std::string name;  // in the legend; none if empty
  std::vector<ChartPoint> points{};
  Color color = series_color(0);
  Marker marker = Marker::disc;
  double line_width = 0;  // pixels; 0 is no line. A point that is left out interrupts the line
  std::vector<double> dashes{};  // of the line, as in Stroke
};

struct ChartAxis {
  std::string title;  // quantity and unit
  ScaleKind kind = ScaleKind::linear;
  TickFormat format = TickFormat::number;
  // What it shows; fitted to the points if not given.
  std::optional<Scale> scale{};
};

// A line across the plot at one value of an axis, such as a goal.
struct Guide {
  enum class Axis { x, y } axis = Axis::y;
  double value = 0;
  std::string label{};
};

struct Chart {
  Words words{};
  ChartAxis x, y;
  std::vector<Series> series{};  // drawn in this order, the last one on top
  std::vector<Guide> guides{};   // included when an axis is fitted
  double font_size = 28;         // pixels; of ticks and labels, the title is larger
};

// Those points that no other beats or equals in both x and y, smaller being better, by ascending x;
// without labels. Points with a NaN are left out.
std::vector<ChartPoint> pareto_front(std::span<const ChartPoint> points);

// Where things stand in a chart drawn into a box.
struct ChartLayout {
  struct Label {
    std::string text;
    Point anchor;
    LabelPlace place;
  };
  Box plot;  // the area between the axes
  Scale x = Scale::linear(0, 1), y = Scale::linear(0, 1);
  std::vector<Tick> x_ticks, y_ticks;
  std::vector<Label> labels;
  std::size_t labels_without_room = 0;  // left out

  // The pixel of a point; not finite if an axis cannot show it.
  Point at(double x_value, double y_value) const;
};

// Computes the layout in a box of a canvas without drawing.
ChartLayout lay_out(const Chart& chart, const Canvas& canvas, const Box& box);

// Draws the chart into a box of a canvas. The box should be at least 20 font sizes wide and high.
void draw(Canvas& canvas, const Box& box, const Chart& chart);

// The chart as a picture of its own.
Canvas render(const Chart& chart, int width = 1600, int height = 1000);

}  // namespace ltc::picture
