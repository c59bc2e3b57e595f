// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A lattice: some nodes of each axis of a grid, what stands at all their crossings, and
// tensor-cubic interpolation from them to the other nodes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "interpolate/axis_cells.h"
#include "interpolate/node_fits.h"
#include "table/grid.h"

namespace ltc {

using LatticeAxes = std::array<AxisNodes, Grid::axis_count>;
using LatticePlace = std::array<std::size_t, Grid::axis_count>;

// The lattice of all axes halved, and one of which every node is a node.
LatticeAxes halved(const LatticeAxes& axes);
std::size_t largest_gap(const LatticeAxes& axes);
std::size_t node_count(const LatticeAxes& axes);

class Lattice {
 public:
  Lattice(const Grid& grid, LatticeAxes axes);

  const LatticeAxes& axes() const { return axes_; }
  std::size_t size() const { return values_.size(); }
  LatticePlace place(std::size_t number) const;
  std::size_t flat(std::size_t number) const;  // of the grid

  NodeValues& operator[](std::size_t number) { return values_[number]; }
  const NodeValues& operator[](std::size_t number) const { return values_[number]; }

  // At a node of the grid.
  NodeValues at(const LatticePlace& indices) const;
  // At all nodes of a list of theta and one of phi, phi fastest, of one alpha and lambda: the same
  // values but for rounding, at a few operations a node.
  std::vector<NodeValues> plane(std::size_t alpha, std::size_t lambda, const AxisNodes& thetas,
                                const AxisNodes& phis) const;

 private:
  const Grid* grid_;
  LatticeAxes axes_;
  LatticePlace strides_;
  std::vector<NodeValues> values_;
};

// The cells of a lattice's axes, each with a flag.
class LatticeCells {
 public:
  LatticeCells(const LatticeAxes& axes, bool flag);

  std::size_t size() const { return flags_.size(); }
  bool operator[](std::size_t number) const { return flags_[number] != 0; }
  void set(std::size_t number, bool flag) { flags_[number] = flag; }

  // The node in its middle, as indices; has_inside is false where it has no nodes but its corners.
  LatticePlace middle(std::size_t number) const;
  bool has_inside(std::size_t number) const;
  // Its first corner, as indices; and the flag of the cell that begins there, or holds what does.
  LatticePlace corner(std::size_t number) const;
  bool behind(const LatticePlace& corner) const;
  // Whether any of the cells that hold a node has the flag, edges included.
  bool any_at(const LatticePlace& indices) const;

 private:
  LatticePlace place(std::size_t number) const;

  LatticeAxes axes_;
  LatticePlace strides_;
  std::vector<std::uint8_t> flags_;
};

}  // namespace ltc
