// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "interpolate/axis_cells.h"

#include <algorithm>

namespace ltc {
namespace {

// Of the last node that is not beyond the index.
std::size_t place_of(const AxisNodes& nodes, std::size_t index) {
  return static_cast<std::size_t>(std::ranges::upper_bound(nodes, index) - nodes.begin()) - 1;
}

}  // namespace

AxisNodes every(std::size_t spacing, std::size_t size) {
  AxisNodes nodes;
  for (std::size_t index = 0; index + 1 < size; index += spacing)
    nodes.push_back(index);
  nodes.push_back(size - 1);
  return nodes;
}

AxisNodes halved(const AxisNodes& nodes) {
  AxisNodes finer;
  for (std::size_t cell = 0; cell + 1 < nodes.size(); ++cell) {
    finer.push_back(nodes[cell]);
    if (const std::size_t middle = middle_of_cell(nodes, cell); middle > nodes[cell])
      finer.push_back(middle);
  }
  finer.push_back(nodes.back());
  return finer;
}

std::size_t largest_gap(const AxisNodes& nodes) {
  std::size_t gap = 0;
  for (std::size_t cell = 0; cell + 1 < nodes.size(); ++cell)
    gap = std::max(gap, nodes[cell + 1] - nodes[cell]);
  return gap;
}

std::size_t cell_count(const AxisNodes& nodes) {
  return std::max<std::size_t>(nodes.size() - 1, 1);
}

std::size_t middle_of_cell(const AxisNodes& nodes, std::size_t cell) {
  return (nodes[cell] + nodes[std::min(cell + 1, nodes.size() - 1)]) / 2;
}

CellRange cells_at(const AxisNodes& nodes, std::size_t index) {
  const std::size_t place = place_of(nodes, index), last = cell_count(nodes) - 1;
  const bool is_node = nodes[place] == index;
  return {is_node && place > 0 ? place - 1 : place, std::min(place, last)};
}

Stencil stencil_at(const AxisNodes& nodes, std::size_t index) {
  const std::size_t place = place_of(nodes, index);
  Stencil stencil;
  stencil.first = place;
  if (nodes[place] == index)
    return stencil;
  stencil.count = std::min<std::size_t>(4, nodes.size());
  stencil.first = std::min(place > 0 ? place - 1 : 0, nodes.size() - stencil.count);
  for (std::size_t i = 0; i < stencil.count; ++i) {
    double weight = 1;
    const auto at = [&](std::size_t k) { return static_cast<double>(nodes[stencil.first + k]); };
    for (std::size_t k = 0; k < stencil.count; ++k)
      if (k != i)
        weight *= (static_cast<double>(index) - at(k)) / (at(i) - at(k));
    stencil.weights[i] = weight;
  }
  return stencil;
}

}  // namespace ltc
