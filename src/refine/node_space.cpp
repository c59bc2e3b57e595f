// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/node_space.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/fold_starts.h"
#include "table/symmetry.h"

namespace ltc {
namespace {

// X S X with X the swap of x and y, row-major; of folded nodes at lambda = 1, which have no fold,
// the rest stays.
template <typename Vector>
Vector swapped(const Vector& value) {
  Vector result = value;
  constexpr int other[3] = {1, 0, 2};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      result[3 * row + column] = value[3 * other[row] + other[column]];
  return result;
}

bool keeps(const Eigen::Matrix3d& matrix, const SingularityBound& bound) {
  return matrix.determinant() >= bound.determinant &&
         solid_angle_of_columns(matrix) >= bound.solid_angle &&
         frobenius_condition(matrix * bound.scale.asDiagonal()) <= bound.condition;
}

bool keeps(const Eigen::Matrix3d&, const Eigen::Matrix3d& matrix, const SingularityBound& bound) {
  return keeps(matrix, bound);
}
bool keeps(const FoldedNode& node, const Eigen::Matrix3d& matrix, const SingularityBound& bound) {
  return keeps(matrix, bound) && node[10] <= bound.gamma;
}

// `node` with another matrix.
Eigen::Matrix3d with_matrix(const Eigen::Matrix3d&, const Eigen::Matrix3d& matrix) {
  return matrix;
}
FoldedNode with_matrix(FoldedNode node, const Eigen::Matrix3d& matrix) {
  node.head<9>() = flattened(matrix);
  return node;
}

// The node of the azimuth pi/2 - phi; the axis' size if there is none.
std::size_t swapped_azimuth(const Axis& phi, std::size_t index) {
  const double wanted = std::numbers::pi / 2 - phi.nodes[index];
  const auto found = std::find_if(phi.nodes.begin(), phi.nodes.end(), [&](double node) {
    return std::abs(node - wanted) <= symmetry_tolerance;
  });
  return static_cast<std::size_t>(found - phi.nodes.begin());
}

}  // namespace

NodeSpace::NodeSpace(const Grid& grid, Storage storage, const std::vector<bool>& movable)
    : storage_(storage) {
  free_.resize(grid.size());
  std::vector<bool> frozen(grid.size());
  for (std::size_t flat = 0; flat < grid.size(); ++flat)
    frozen[flat] = !movable[flat];
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const NodeIndex node = grid.node(flat);
    const bool upward = looks_upward(grid.theta.nodes[node.theta]);
    const bool isotropic = grid.lambda.nodes[node.lambda] == 1;
    const std::size_t mirror = swapped_azimuth(grid.phi, node.phi);
    if (upward ? node.phi != 0 : !(isotropic && node.phi <= mirror && mirror < grid.phi.size()))
      continue;
    std::vector<Image> orbit;
    for (std::size_t phi = 0; phi < grid.phi.size(); ++phi) {
      const std::size_t tied = grid.flat({node.alpha, node.lambda, node.theta, phi});
      if (upward || phi == node.phi)
        orbit.push_back({tied, false});
      if (isotropic && (upward || phi == mirror))
        orbit.push_back({tied, true});
    }
    if (std::any_of(orbit.begin(), orbit.end(), [&](Image image) { return frozen[image.node]; }))
      for (const Image image : orbit)
        frozen[image.node] = true;
    if (orbit.size() > 1)
      orbits_.push_back(std::move(orbit));
  }
  for (std::size_t flat = 0; flat < grid.size(); ++flat)
    free_[flat] = frozen[flat] ? FreeEntries{} : free_entries(grid.lobe(flat));
  free_fold_.resize(grid.size());
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const NodeIndex node = grid.node(flat);
    const bool folds = !frozen[flat] && grid.lambda.nodes[node.lambda] != 1;
    if (folds)
      free_fold_[flat] = free_fold(grid.lobe(flat));
  }
  if (storage != Storage::inverse)
    return;
  // The middle entry is 1, and so is the first of an upward view, which is the same with x and y
  // swapped.
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    free_[flat][4] = false;
    if (looks_upward(grid.theta.nodes[grid.node(flat).theta]))
      free_[flat][0] = false;
  }
}

template <typename Values>
void NodeSpace::average_orbits(Values& values) const {
  using Vector = typename Values::value_type;
  for (const std::vector<Image>& orbit : orbits_) {
    Vector mean = Vector::Zero();
    for (const Image image : orbit)
      mean += image.swapped ? swapped(values[image.node]) : values[image.node];
    mean /= static_cast<double>(orbit.size());
    for (const Image image : orbit)
      values[image.node] = image.swapped ? swapped(mean) : mean;
  }
}

void NodeSpace::project_fold(NodeVectorsOf<FoldedNode>& step) const {
  for (std::size_t flat = 0; flat < step.size(); ++flat)
    for (std::size_t i = 0; i < 2; ++i)
      if (!free_fold_[flat][i])
        step[flat][9 + static_cast<Eigen::Index>(i)] = 0;
}

template <typename Node>
void NodeSpace::project(const std::vector<Node>& stored, NodeVectorsOf<Node>& step) const {
  if constexpr (is_folded_node<Node>)
    project_fold(step);
  for (std::size_t flat = 0; flat < step.size(); ++flat) {
    NodeVector<Node>& value = step[flat];
    for (int entry = 0; entry < 9; ++entry)
      if (!free_[flat][entry])
        value[entry] = 0;
    if (storage_ == Storage::inverse)
      continue;
    const Eigen::Vector3d axis = matrix_of(stored[flat]).col(2);
    const double along = axis.x() * value[2] + axis.y() * value[5] + axis.z() * value[8];
    const double share = along / axis.squaredNorm();
    if (free_[flat][8])
      for (int row = 0; row < 3; ++row)
        value[3 * row + 2] -= share * axis[row];
  }
  average_orbits(step);
}

template <typename Node>
void NodeSpace::symmetrise(std::vector<Node>& stored) const {
  NodeVectorsOf<Node> values(stored.size());
  for (std::size_t flat = 0; flat < stored.size(); ++flat)
    values[flat] = flattened(stored[flat]);
  average_orbits(values);
  for (std::size_t flat = 0; flat < stored.size(); ++flat)
    stored[flat] = node_of<Node>(values[flat]);
}

template void NodeSpace::project(const std::vector<Eigen::Matrix3d>&, NodeVectors&) const;
template void NodeSpace::project(const std::vector<FoldedNode>&, NodeVectorsOf<FoldedNode>&) const;
template void NodeSpace::symmetrise(std::vector<Eigen::Matrix3d>&) const;
template void NodeSpace::symmetrise(std::vector<FoldedNode>&) const;

double solid_angle_of_columns(const Eigen::Matrix3d& matrix) {
  return matrix.colwise().normalized().determinant();
}

double frobenius_condition(const Eigen::Matrix3d& matrix) {
  return matrix.norm() * matrix.inverse().norm();
}

template <typename Node>
std::vector<Node> stepped(Storage storage, const std::vector<Node>& stored,
                          const NodeVectorsOf<Node>& step,
                          const std::vector<SingularityBound>& bounds) {
  constexpr int most_halvings = 30;
  std::vector<Node> result = stored;
  for (std::size_t flat = 0; flat < stored.size(); ++flat) {
    if (step[flat].isZero(0))
      continue;
    Node change = node_of<Node>(step[flat]);
    for (int halvings = 0; halvings < most_halvings; ++halvings, change /= 2) {
      const Node candidate = stored[flat] + change;
      Eigen::Matrix3d matrix = matrix_of(candidate);
      matrix /= scale_of(storage, matrix);
      if (keeps(candidate, matrix, bounds[flat])) {
        result[flat] = with_matrix(candidate, matrix);
        break;
      }
    }
  }
  return result;
}

template std::vector<Eigen::Matrix3d> stepped(Storage, const std::vector<Eigen::Matrix3d>&,
                                              const NodeVectors&,
                                              const std::vector<SingularityBound>&);
template std::vector<FoldedNode> stepped(Storage, const std::vector<FoldedNode>&,
                                         const NodeVectorsOf<FoldedNode>&,
                                         const std::vector<SingularityBound>&);

}  // namespace ltc
