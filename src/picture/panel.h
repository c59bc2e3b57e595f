// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Square images side by side with shared colour scales: a lobe, its fit and their difference.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "picture/canvas.h"
#include "picture/text.h"

namespace ltc::picture {

struct Panel {
  std::string title;
  Field field;            // stretched to the panel's square; NaN is the scale's `no_value`
  std::size_t scale = 0;  // index into PanelRow::scales
};

// A line drawn over every panel, such as the horizon. Coordinates are fractions of a panel's side:
// x to the right, y down, (0, 0) its top left corner.
struct Overlay {
  std::vector<Point> points;
  Stroke stroke{Color::hex(0x9a9a9a), 1.5};
  std::string label{};  // to the right of the last point
};

struct PanelRow {
  Words words{};
  std::vector<Panel> panels{};
  // Each has its colour bar below the panels that use it; those should be neighbours.
  std::vector<ColorScale> scales{};
  std::vector<Overlay> overlays{};
  Sampling sampling = Sampling::linear;
  double font_size = 20;  // pixels
};

// Where things stand in a row drawn into a box, in pixels.
struct PanelLayout {
  std::vector<Box> panels;  // equal squares of whole pixels
  std::vector<Box> bars;    // one for each scale; empty for one that no panel uses
};

// Height in pixels that a row needs to fill a width.
double height_for_width(const PanelRow& row, double width);

// Throws InputError if there is no panel, or if one names a scale that there is not.
PanelLayout lay_out(const PanelRow& row, const Box& box);

// Draws the row into a box of a canvas.
void draw(Canvas& canvas, const Box& box, const PanelRow& row);

// The row as a picture of its own.
Canvas render(const PanelRow& row, int width = 1600);

}  // namespace ltc::picture
