// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// One axis of a table: its nodes, and the warp that makes interpolation linear between them.
#pragma once

#include <cstddef>
#include <vector>

#include "core/enum_names.h"

namespace ltc {

// How the interpolation coordinate u follows from x = (value - first)/(last - first).
enum class Warp {
  linear,           // u = x
  sqrt,             // u = sqrt(x): nodes dense near `first`
  complement_sqrt,  // u = 1 - sqrt(1 - x): nodes dense near `last`
  // u linear in sin(value/2), for angles: sqrt(1 - cos(value)) / sqrt(1 - cos(last)) from first = 0
  // on, the coordinate of the tables that engines ship.
  half_sine,
};

constexpr EnumNames<Warp, 4> enum_names(Warp) {
  return {"warp",
          {{{Warp::linear, "linear"},
            {Warp::sqrt, "sqrt"},
            {Warp::complement_sqrt, "complement-sqrt"},
            {Warp::half_sine, "half-sine"}}}};
}

struct Axis {
  std::vector<double> nodes;  // strictly increasing
  Warp warp = Warp::linear;

  // `count` >= 1 nodes from first to last, at u = i/(count - 1). One node stands at `first`.
  static Axis make(double first, double last, std::size_t count, Warp warp);

  std::size_t size() const { return nodes.size(); }
  double first() const { return nodes.front(); }
  double last() const { return nodes.back(); }

  // Interpolation coordinate of a value, clamped to [0, 1]; and its inverse.
  double coordinate(double value) const;
  double value(double coordinate) const;

  // Where a look-up finds a value, in nodes: coordinate times (size - 1), and exactly k within 1e-9
  // of node k, so that a value at a node takes nothing from the next one. NaN for NaN.
  double position(double value) const;

  bool operator==(const Axis&) const = default;
};

}  // namespace ltc
