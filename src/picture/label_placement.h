// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Finds room for labels beside points, so that no label covers another, a marker or an edge.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "picture/geometry.h"

namespace ltc::picture {

struct LabelRequest {
  Point anchor;                  // the point it belongs to
  double width = 0, height = 0;  // of the text
};

struct LabelPlace {
  Box box;
  // Set when the label stands too far from its point to be read as its own: a line to draw to here.
  std::optional<Point> leader_end;
};

struct Segment {
  Point from, to;
};

// Whether any of the segment lies in the box.
bool crosses(const Segment& segment, const Box& box);

// A place for each request, in their order. Certain: placed labels lie within `bounds` and overlap
// neither each other nor any of the `obstacles` (markers, fixed text). Sought, in this order of
// weight: near its point, to the right of and above it, off the `lines`. `clearance` is the
// distance in pixels to keep from the anchor (the radius of the marker). A label for which there is
// no room gets no place. Equal input gives equal places.
std::vector<std::optional<LabelPlace>> place_labels(std::span<const LabelRequest> requests,
                                                    double clearance, const Box& bounds,
                                                    std::span<const Box> obstacles,
                                                    std::span<const Segment> lines);

}  // namespace ltc::picture
