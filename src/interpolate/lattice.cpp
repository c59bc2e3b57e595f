// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "interpolate/lattice.h"

#include <algorithm>

namespace ltc {
namespace {

constexpr std::size_t axis_count = Grid::axis_count;

// In C order, the last fastest.
LatticePlace strides_of(const LatticePlace& shape) {
  LatticePlace strides{};
  std::size_t stride = 1;
  for (std::size_t axis = axis_count; axis-- > 0; stride *= shape[axis])
    strides[axis] = stride;
  return strides;
}

LatticePlace place_of(std::size_t number, const LatticePlace& strides) {
  LatticePlace place{};
  for (std::size_t axis = 0; axis < axis_count; number %= strides[axis], ++axis)
    place[axis] = number / strides[axis];
  return place;
}

template <typename Count>
LatticePlace shape_of(const LatticeAxes& axes, Count&& count) {
  LatticePlace shape{};
  std::ranges::transform(axes, shape.begin(), count);
  return shape;
}

LatticePlace node_shape(const LatticeAxes& axes) {
  return shape_of(axes, [](const AxisNodes& nodes) { return nodes.size(); });
}

std::vector<Stencil> stencils_at(const AxisNodes& nodes, const AxisNodes& indices) {
  std::vector<Stencil> stencils;
  for (const std::size_t index : indices)
    stencils.push_back(stencil_at(nodes, index));
  return stencils;
}

}  // namespace

LatticeAxes halved(const LatticeAxes& axes) {
  LatticeAxes finer;
  std::ranges::transform(axes, finer.begin(), [](const AxisNodes& nodes) { return halved(nodes); });
  return finer;
}

std::size_t largest_gap(const LatticeAxes& axes) {
  std::size_t gap = 0;
  for (const AxisNodes& nodes : axes)
    gap = std::max(gap, largest_gap(nodes));
  return gap;
}

std::size_t node_count(const LatticeAxes& axes) {
  std::size_t count = 1;
  for (const AxisNodes& nodes : axes)
    count *= nodes.size();
  return count;
}

Lattice::Lattice(const Grid& grid, LatticeAxes axes)
    : grid_(&grid),
      axes_(std::move(axes)),
      strides_(strides_of(node_shape(axes_))),
      values_(node_count(axes_)) {}

LatticePlace Lattice::place(std::size_t number) const {
  return place_of(number, strides_);
}

std::size_t Lattice::flat(std::size_t number) const {
  const LatticePlace at = place(number);
  return grid_->flat({axes_[0][at[0]], axes_[1][at[1]], axes_[2][at[2]], axes_[3][at[3]]});
}

NodeValues Lattice::at(const LatticePlace& indices) const {
  std::array<Stencil, axis_count> stencils;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    stencils[axis] = stencil_at(axes_[axis], indices[axis]);
  NodeValues sum = NodeValues::Zero();
  const auto add = [&](auto& self, std::size_t axis, std::size_t number, double weight) -> void {
    if (axis == axis_count) {
      sum += weight * values_[number];
      return;
    }
    const Stencil& stencil = stencils[axis];
    for (std::size_t i = 0; i < stencil.count; ++i)
      self(self, axis + 1, number + (stencil.first + i) * strides_[axis],
           weight * stencil.weights[i]);
  };
  add(add, 0, 0, 1);
  return sum;
}

std::vector<NodeValues> Lattice::plane(std::size_t alpha, std::size_t lambda,
                                       const AxisNodes& thetas, const AxisNodes& phis) const {
  // Axis by axis, so that nothing is summed more than four times.
  const std::size_t coarse_phis = axes_[3].size(), coarse = strides_[1];
  std::vector<NodeValues> flat(coarse, NodeValues::Zero());
  const Stencil of_alpha = stencil_at(axes_[0], alpha), of_lambda = stencil_at(axes_[1], lambda);
  for (std::size_t i = 0; i < of_alpha.count; ++i)
    for (std::size_t j = 0; j < of_lambda.count; ++j) {
      const double weight = of_alpha.weights[i] * of_lambda.weights[j];
      const NodeValues* const from =
          &values_[(of_alpha.first + i) * strides_[0] + (of_lambda.first + j) * strides_[1]];
      for (std::size_t k = 0; k < coarse; ++k)
        flat[k] += weight * from[k];
    }
  const std::vector<Stencil> of_phi = stencils_at(axes_[3], phis);
  std::vector<NodeValues> row(coarse_phis), result;
  result.reserve(thetas.size() * phis.size());
  for (const std::size_t theta : thetas) {
    const Stencil of_theta = stencil_at(axes_[2], theta);
    std::ranges::fill(row, NodeValues::Zero());
    for (std::size_t i = 0; i < of_theta.count; ++i)
      for (std::size_t k = 0; k < coarse_phis; ++k)
        row[k] += of_theta.weights[i] * flat[(of_theta.first + i) * coarse_phis + k];
    for (const Stencil& stencil : of_phi) {
      NodeValues sum = NodeValues::Zero();
      for (std::size_t i = 0; i < stencil.count; ++i)
        sum += stencil.weights[i] * row[stencil.first + i];
      result.push_back(sum);
    }
  }
  return result;
}

LatticeCells::LatticeCells(const LatticeAxes& axes, bool flag)
    : axes_(axes), strides_(strides_of(shape_of(axes, cell_count))) {
  flags_.assign(strides_[0] * cell_count(axes[0]), flag);
}

LatticePlace LatticeCells::place(std::size_t number) const {
  return place_of(number, strides_);
}

LatticePlace LatticeCells::middle(std::size_t number) const {
  LatticePlace at = place(number);
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    at[axis] = middle_of_cell(axes_[axis], at[axis]);
  return at;
}

bool LatticeCells::has_inside(std::size_t number) const {
  return middle(number) != corner(number);
}

LatticePlace LatticeCells::corner(std::size_t number) const {
  LatticePlace at = place(number);
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    at[axis] = axes_[axis][at[axis]];
  return at;
}

bool LatticeCells::behind(const LatticePlace& corner) const {
  std::size_t number = 0;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    number += cells_at(axes_[axis], corner[axis]).last * strides_[axis];
  return flags_[number] != 0;
}

bool LatticeCells::any_at(const LatticePlace& indices) const {
  std::array<CellRange, axis_count> range;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    range[axis] = cells_at(axes_[axis], indices[axis]);
  const auto any = [&](auto& self, std::size_t axis, std::size_t number) -> bool {
    if (axis == axis_count)
      return flags_[number] != 0;
    for (std::size_t cell = range[axis].first; cell <= range[axis].last; ++cell)
      if (self(self, axis + 1, number + cell * strides_[axis]))
        return true;
    return false;
  };
  return any(any, 0, 0);
}

}  // namespace ltc
