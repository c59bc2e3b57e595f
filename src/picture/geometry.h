// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Points and boxes of a picture, in pixels: x to the right, y down, (0, 0) the outer corner of the
// top left pixel, whose centre is (0.5, 0.5).
#pragma once

namespace ltc::picture {

struct Point {
  double x = 0, y = 0;
};

struct Box {
  double left = 0, top = 0, width = 0, height = 0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
  Point center() const { return {left + width / 2, top + height / 2}; }

  // The box without (or, if negative, with more of) so much at all four sides.
  Box inset(double by) const { return {left + by, top + by, width - 2 * by, height - 2 * by}; }

  // Boxes that merely touch do not overlap.
  bool overlaps(const Box& other) const {
    return left < other.right() && other.left < right() && top < other.bottom() &&
           other.top < bottom();
  }
  bool contains(const Box& other) const {
    return other.left >= left && other.right() <= right() && other.top >= top &&
           other.bottom() <= bottom();
  }
  bool contains(Point point) const {
    return point.x >= left && point.x <= right() && point.y >= top && point.y <= bottom();
  }

  // Each cuts a strip off one side of this box and returns the strip.
  Box take_top(double height_taken) {
    const Box strip{left, top, width, height_taken};
    top += height_taken;
    height -= height_taken;
    return strip;
  }
  Box take_bottom(double height_taken) {
    height -= height_taken;
    return {left, bottom(), width, height_taken};
  }
  Box take_left(double width_taken) {
    const Box strip{left, top, width_taken, height};
    left += width_taken;
    width -= width_taken;
    return strip;
  }
  Box take_right(double width_taken) {
    width -= width_taken;
    return {right(), top, width_taken, height};
  }
};

}  // namespace ltc::picture
