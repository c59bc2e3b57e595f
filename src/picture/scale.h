// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Scales: values to positions along an axis or a colour bar, and the ticks that label them.
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "picture/color.h"

namespace ltc::picture {

enum class ScaleKind { linear, logarithmic, symmetric_logarithmic };

// How ticks are written.
enum class TickFormat {
  number,    // "0.02", "1", "5000", "10⁻⁷"
  percent,   // of a value where 1 is the whole: 0.05 is "5 %"
  duration,  // of seconds: "1 ms", "10 s", "1 min", "1 h", "1 day"
};

struct Tick {
  double value = 0;
  std::string label;  // empty for a minor tick, which gets a grid line alone
};

// A monotone map of the values [first, last] onto positions [0, 1].
class Scale {
 public:
  // `first` < `last`, both finite, else InputError.
  static Scale linear(double first, double last);
  // The same, and 0 < `first`.
  static Scale logarithmic(double first, double last);
  // From -bound to bound with 0 in the middle: asinh(value / linear_within), which is linear within
  // `linear_within` of zero and logarithmic beyond. 0 < `linear_within`, 0 < `bound`.
  static Scale symmetric_logarithmic(double bound, double linear_within);
  // A linear or logarithmic scale that holds all those of the values that it can show (finite, and
  // positive if logarithmic) with `margin` of its length to spare on either side; 0 to 1 or 0.1 to
  // 10 if there are none. A single value gets a stretch around it.
  static Scale around(std::span<const double> values, ScaleKind kind, double margin = 0.06);

  ScaleKind kind() const { return kind_; }
  double first() const { return first_; }
  double last() const { return last_; }

  // In [0, 1] for values in [first, last], outside it for others. NaN stays NaN; a value <= 0 is
  // at minus infinity on a logarithmic scale.
  double position(double value) const;
  // Undoes `position`.
  double value(double position) const;

  // Ticks at round values in [first, last], ascending: steps of 1, 2 or 5; decades, with 2 and 5 or
  // 3 between them where there is room; round durations. At most `at_most` have a label, or 2 (3 on
  // a symmetric scale) if that is less; a logarithmic scale of several decades has minor ones too.
  std::vector<Tick> ticks(TickFormat format, std::size_t at_most) const;

 private:
  Scale(ScaleKind kind, double first, double last, double linear_within);
  double warp(double value) const;

  ScaleKind kind_;
  double first_, last_;
  double linear_within_;  // of the symmetric kind
};

// A value as ticks write it, with as many digits as `number` needs up to six.
std::string format_value(double value, TickFormat format = TickFormat::number);

// What a colour says: values to colours, with the words for the legend.
struct ColorScale {
  Scale scale;
  const ColorMap* map = &ColorMap::viridis();  // not owned
  std::string title{};                         // quantity and unit
  TickFormat format = TickFormat::number;
  Color no_value = missing;  // of NaN

  // Values outside the scale take the colour of its nearer end.
  Color at(double value) const {
    return std::isnan(value) ? no_value : map->at(scale.position(value));
  }
};

}  // namespace ltc::picture
