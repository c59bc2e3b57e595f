// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "interpolate/axis_probe.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ltc {
namespace {

constexpr std::size_t axis_count = Grid::axis_count;
constexpr std::size_t most_nodes_kept = 12;

// By so much a single line weighs at most: one that jumps shall not decide for all.
constexpr double largest_counted = 0.03;

AxisNodes coarsest(std::size_t size, std::size_t nodes) {
  return size <= most_nodes_kept ? every(1, size) : every(std::bit_floor(size / nodes), size);
}

// Roberts's additive sequence in three dimensions: x^4 = x + 1.
constexpr double root = 1.2207440846057596;

// Where line `number` of an axis crosses the others, as indices; its own is 0.
LatticePlace line_at(const LatticeAxes& axes, std::size_t along, std::size_t number) {
  LatticePlace place{};
  double step = 1;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (axis == along)
      continue;
    step /= root;
    const double at = 0.5 + static_cast<double>(number + 1) * step;
    const auto count = static_cast<double>(axes[axis].size());
    place[axis] = axes[axis][static_cast<std::size_t>((at - std::floor(at)) * count)];
  }
  return place;
}

class Probe {
 public:
  Probe(const Grid& grid, const ProbeSettings& settings, NodeFits& fits)
      : grid_(grid), settings_(settings), fits_(fits) {
    for (std::size_t axis = 0; axis < axis_count; ++axis)
      coarse_[axis] = coarsest(grid.axis(axis).size(), settings.nodes);
  }

  AxisNodes nodes_of(std::size_t along) const {
    AxisNodes nodes = coarse_[along];
    std::vector<std::size_t> good;  // first nodes of intervals
    for (;;) {
      const std::vector<std::size_t> asked = cells_to_ask(nodes, good);
      if (asked.empty())
        return nodes;
      const std::vector<double> excess = mean_excess(along, nodes, asked);
      AxisNodes finer = nodes;
      for (std::size_t i = 0; i < asked.size(); ++i)
        if (excess[i] > settings_.tolerance)
          finer.push_back(middle_of_cell(nodes, asked[i]));
        else
          good.push_back(nodes[asked[i]]);
      std::ranges::sort(finer);
      nodes = std::move(finer);
    }
  }

 private:
  static std::vector<std::size_t> cells_to_ask(const AxisNodes& nodes,
                                               const std::vector<std::size_t>& good) {
    std::vector<std::size_t> cells;
    for (std::size_t cell = 0; cell + 1 < nodes.size(); ++cell)
      if (nodes[cell + 1] > nodes[cell] + 1 && std::ranges::find(good, nodes[cell]) == good.end())
        cells.push_back(cell);
    return cells;
  }

  std::vector<double> mean_excess(std::size_t along, const AxisNodes& nodes,
                                  const std::vector<std::size_t>& cells) const {
    const auto flat = [&](LatticePlace place, std::size_t index) {
      place[along] = index;
      return grid_.flat({place[0], place[1], place[2], place[3]});
    };
    std::vector<std::size_t> all, middles;
    for (std::size_t line = 0; line < settings_.lines; ++line) {
      const LatticePlace place = line_at(coarse_, along, line);
      for (const std::size_t index : nodes)
        all.push_back(flat(place, index));
      for (const std::size_t cell : cells)
        middles.push_back(flat(place, middle_of_cell(nodes, cell)));
    }
    fits_.fit("probe", all);
    std::vector<NodeValues> interpolated;
    for (std::size_t line = 0; line < settings_.lines; ++line) {
      const LatticePlace place = line_at(coarse_, along, line);
      for (const std::size_t cell : cells) {
        const Stencil stencil = stencil_at(nodes, middle_of_cell(nodes, cell));
        NodeValues sum = NodeValues::Zero();
        for (std::size_t i = 0; i < stencil.count; ++i)
          sum += stencil.weights[i] * fits_.values_at(flat(place, nodes[stencil.first + i]));
        interpolated.push_back(sum);
      }
    }
    const std::vector<double> excess = fits_.excess("probe", middles, interpolated);
    std::vector<double> mean(cells.size());
    for (std::size_t i = 0; i < excess.size(); ++i) {
      const bool known = excess[i] <= largest_counted;  // not where it is NaN
      mean[i % cells.size()] += (known ? std::max(excess[i], 0.0) : largest_counted) /
                                static_cast<double>(settings_.lines);
    }
    return mean;
  }

  const Grid& grid_;
  const ProbeSettings& settings_;
  NodeFits& fits_;
  LatticeAxes coarse_;
};

}  // namespace

bool has_long_axis(const Grid& grid) {
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    if (grid.axis(axis).size() > most_nodes_kept)
      return true;
  return false;
}

LatticeAxes probe_axes(const Grid& grid, const ProbeSettings& settings, NodeFits& fits) {
  const Probe probe(grid, settings, fits);
  LatticeAxes axes;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    axes[axis] = probe.nodes_of(axis);
  return axes;
}

}  // namespace ltc
