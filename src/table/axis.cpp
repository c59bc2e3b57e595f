// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/axis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"

namespace ltc {
namespace {

// u of a value within the axis, and back.
double warped(const Axis& axis, double value) {
  const double first = axis.first(), last = axis.last();
  const double x = (value - first) / (last - first);
  switch (axis.warp) {
    case Warp::linear:
      return x;
    case Warp::sqrt:
      return std::sqrt(x);
    case Warp::complement_sqrt:
      return x / (1 + std::sqrt(1 - x));  // 1 - sqrt(1 - x), near x = 0 too
    case Warp::half_sine:
      return (std::sin(value / 2) - std::sin(first / 2)) /
             (std::sin(last / 2) - std::sin(first / 2));
  }
  return x;
}

double unwarped(Warp warp, double first, double last, double u) {
  const auto at = [&](double x) { return first + (last - first) * x; };
  switch (warp) {
    case Warp::linear:
      return at(u);
    case Warp::sqrt:
      return at(u * u);
    case Warp::complement_sqrt:
      return at(1 - (1 - u) * (1 - u));
    case Warp::half_sine:
      return 2 * std::asin(std::sin(first / 2) + (std::sin(last / 2) - std::sin(first / 2)) * u);
  }
  return at(u);
}

void require_range(double first, double last, std::size_t count) {
  if (count == 0)
    throw InputError("axis has 0 nodes; allowed: 1 or more");
  if (!std::isfinite(first) || !std::isfinite(last) || (count > 1 && !(first < last)))
    throw InputError(
        fmt::format("axis runs from {} to {}; both must be finite and the first less than the last",
                    first, last));
}

}  // namespace

Axis Axis::make(double first, double last, std::size_t count, Warp warp) {
  require_range(first, last, count);
  Axis axis{{first}, warp};
  axis.nodes.reserve(count);
  for (std::size_t i = 1; i < count; ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(count - 1);
    axis.nodes.push_back(unwarped(warp, first, last, u));
  }
  // What the last comes to may round to a neighbour of it; files promise it itself.
  if (count > 1)
    axis.nodes.back() = last;
  return axis;
}

double Axis::coordinate(double value) const {
  if (size() == 1)
    return std::isnan(value) ? value : 0.0;
  return std::clamp(warped(*this, std::clamp(value, first(), last())), 0.0, 1.0);
}

double Axis::position(double value) const {
  // The warp and its inverse return a node's value only to within rounding. Without the snap, a
  // look-up at a node would give a weight of 1e-16 to a neighbour that may be skipped.
  constexpr double rounding = 1e-9;
  const double position = coordinate(value) * static_cast<double>(size() - 1);
  const double node = std::round(position);
  return std::abs(position - node) < rounding ? node : position;
}

double Axis::value(double coordinate) const {
  return unwarped(warp, first(), last(), std::clamp(coordinate, 0.0, 1.0));
}

}  // namespace ltc
