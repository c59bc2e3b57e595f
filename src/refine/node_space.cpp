// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/node_space.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "table/symmetry.h"

namespace ltc {
namespace {

// X S X with X the swap of x and y, row-major.
Vector9 swapped(const Vector9& value) {
  Vector9 result;
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

void NodeSpace::average_orbits(NodeVectors& values) const {
  for (const std::vector<Image>& orbit : orbits_) {
    Vector9 mean = Vector9::Zero();
    for (const Image image : orbit)
      mean += image.swapped ? swapped(values[image.node]) : values[image.node];
    mean /= static_cast<double>(orbit.size());
    for (const Image image : orbit)
      values[image.node] = image.swapped ? swapped(mean) : mean;
  }
}

void NodeSpace::project(const std::vector<Eigen::Matrix3d>& stored, NodeVectors& step) const {
  for (std::size_t flat = 0; flat < step.size(); ++flat) {
    Vector9& value = step[flat];
    for (int entry = 0; entry < 9; ++entry)
      if (!free_[flat][entry])
        value[entry] = 0;
    if (storage_ == Storage::inverse)
      continue;
    const Eigen::Vector3d axis = stored[flat].col(2);
    const double along = axis.x() * value[2] + axis.y() * value[5] + axis.z() * value[8];
    const double share = along / axis.squaredNorm();
    if (free_[flat][8])
      for (int row = 0; row < 3; ++row)
        value[3 * row + 2] -= share * axis[row];
  }
  average_orbits(step);
}

void NodeSpace::symmetrise(std::vector<Eigen::Matrix3d>& stored) const {
  NodeVectors values(stored.size());
  for (std::size_t flat = 0; flat < stored.size(); ++flat)
    values[flat] = flattened(stored[flat]);
  average_orbits(values);
  for (std::size_t flat = 0; flat < stored.size(); ++flat)
    stored[flat] = unflattened(values[flat]);
}

double solid_angle_of_columns(const Eigen::Matrix3d& matrix) {
  return matrix.colwise().normalized().determinant();
}

double frobenius_condition(const Eigen::Matrix3d& matrix) {
  return matrix.norm() * matrix.inverse().norm();
}

std::vector<Eigen::Matrix3d> stepped(Storage storage, const std::vector<Eigen::Matrix3d>& stored,
                                     const NodeVectors& step,
                                     const std::vector<SingularityBound>& bounds) {
  constexpr int most_halvings = 30;
  std::vector<Eigen::Matrix3d> result = stored;
  for (std::size_t flat = 0; flat < stored.size(); ++flat) {
    if (step[flat].isZero(0))
      continue;
    Eigen::Matrix3d change = unflattened(step[flat]);
    for (int halvings = 0; halvings < most_halvings; ++halvings, change /= 2) {
      Eigen::Matrix3d candidate = stored[flat] + change;
      candidate /= scale_of(storage, candidate);
      if (keeps(candidate, bounds[flat])) {
        result[flat] = candidate;
        break;
      }
    }
  }
  return result;
}

}  // namespace ltc
