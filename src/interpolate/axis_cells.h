// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Some of the nodes of an axis, the cells between them, and cubic interpolation from them to the
// others.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace ltc {

// Rising indices of nodes of an axis of `size` >= 1, 0 and size - 1 among them.
using AxisNodes = std::vector<std::size_t>;

AxisNodes every(std::size_t spacing, std::size_t size);  // of these spacing, and the last
AxisNodes halved(const AxisNodes& nodes);                // and the middle of every gap above 1
std::size_t largest_gap(const AxisNodes& nodes);

// Cell k lies between node k and the next one; an axis of one node has one cell, that node.
std::size_t cell_count(const AxisNodes& nodes);
// The middle of a cell, rounded down: its first node where there is none between.
std::size_t middle_of_cell(const AxisNodes& nodes, std::size_t cell);

// The cells that hold an index, their ends included: one, or the two beside a node.
struct CellRange {
  std::size_t first, last;
};
CellRange cells_at(const AxisNodes& nodes, std::size_t index);

// Lagrange's cubic through the four nodes about an index, through fewer where there are fewer; at
// the ends of an axis those nearest. In indices, in which the table's warp is linear. Of a node
// itself that node alone.
struct Stencil {
  std::size_t first = 0, count = 1;  // places in AxisNodes
  std::array<double, 4> weights{1, 0, 0, 0};
};
Stencil stencil_at(const AxisNodes& nodes, std::size_t index);

}  // namespace ltc
