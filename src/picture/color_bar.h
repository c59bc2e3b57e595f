// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The legend of a colour scale: a bar of its colours with ticks and its title.
#pragma once

#include <span>

#include "picture/canvas.h"

namespace ltc::picture {

// Whether data lie outside a scale; the bar then has a pointed end there.
struct Beyond {
  bool below = false;
  bool above = false;
};
Beyond beyond(const Scale& scale, std::span<const float> values);

// Both or neither where two fields share a scale.
inline Beyond operator|(Beyond a, Beyond b) {
  return {a.below || b.below, a.above || b.above};
}

// An upright bar, last value at the top: ticks to its right, title beside them, read upwards.
// Draws within `box`, whose width should be at least `upright_bar_width`; sizes in pixels.
void draw_upright_bar(Canvas& canvas, Box box, const ColorScale& colors, double font_size,
                      Beyond outside = {});
double upright_bar_width(const Canvas& canvas, const ColorScale& colors, double height,
                         double font_size);

// A lying bar, last value at the right: title above it, ticks below. `box` should be at least
// `lying_bar_height` high.
void draw_lying_bar(Canvas& canvas, Box box, const ColorScale& colors, double font_size,
                    Beyond outside = {});
double lying_bar_height(double font_size);

}  // namespace ltc::picture
