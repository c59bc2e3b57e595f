// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Colours: sRGB triples, the ones all pictures share, and maps from [0, 1] to colours.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ltc::picture {

// An sRGB colour, gamma-encoded, each channel in [0, 1].
struct Color {
  double red = 0, green = 0, blue = 0;

  // From 0xrrggbb.
  static constexpr Color hex(std::uint32_t rgb) {
    return {(rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0};
  }
  bool operator==(const Color&) const = default;
};

// What is not data, the same in every picture.
inline constexpr Color white{1, 1, 1};
inline constexpr Color ink{0.13, 0.14, 0.16};        // text and frames
inline constexpr Color faint_ink{0.40, 0.42, 0.45};  // subtitles, captions, leader lines
inline constexpr Color grid_ink{0.86, 0.87, 0.88};
inline constexpr Color missing{0.72, 0.72, 0.72};  // where there is no value (NaN)

// Colours for series that stay apart for colour-blind readers (Okabe and Ito, Color Universal
// Design, 2008), the yellow left out because it is lost on white. Repeats after seven.
Color series_color(std::size_t index);

// Perceived lightness of a colour, 0 for black and 1 for white: L of Oklab (Ottosson, A perceptual
// color space for image processing, 2020).
double lightness(const Color& color);

// Colours along [0, 1]: a cubic (Catmull-Rom) through equally spaced control points, in Oklab,
// where equal distances look equal.
class ColorMap {
 public:
  // Control points as 0xrrggbb, at least three.
  explicit ColorMap(std::span<const std::uint32_t> control_points);

  // Dark violet to yellow, ever lighter (van der Walt and Smith 2015, CC0). No channel is further
  // than 0.003 from the published table.
  static const ColorMap& viridis();

  // Blue over near-white to red, lightest at 0.5, equally dark at equal distance from it; told
  // apart by readers with any of the common colour-vision deficiencies, as the hues are blue and
  // red.
  static const ColorMap& diverging();

  // The colour at a position, which is clamped to [0, 1]; `missing` for NaN.
  Color at(double position) const;

 private:
  using Oklab = std::array<double, 3>;
  std::vector<Oklab> points_;  // with one extrapolated point at either end
};

}  // namespace ltc::picture
