// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/sample_sets.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/random.h"

namespace ltc {

CosineSet make_cosine_set(std::size_t count, double shift) {
  const std::size_t n = lattice_size(count);
  CosineSet set{AlignedFloats(n), AlignedFloats(n), AlignedFloats(n), {}};
  for (std::size_t i = 0; i < n; ++i) {
    const auto [azimuth, height] = lattice_point(i, n, shift, place_of_slopes);
    const double radius = std::sqrt(height);
    set.x[i] = static_cast<float>(radius * std::cos(azimuth));
    set.y[i] = static_cast<float>(radius * std::sin(azimuth));
    set.z[i] = static_cast<float>(std::sqrt(1 - height));
  }
  return set;
}

std::size_t CosineSet::total() const {
  return total_of(multiplicity, size());
}

std::size_t total_of(const AlignedVector<std::int32_t>& multiplicity, std::size_t samples) {
  std::size_t sum = multiplicity.empty() ? samples : 0;
  for (const std::int32_t count : multiplicity)
    sum += static_cast<std::size_t>(count);
  return sum;
}

CosineSet make_graded_cosine_set(std::size_t count) {
  const GradedLattice lattice = make_graded_lattice(count);
  const std::size_t n = lattice.size();
  CosineSet set{AlignedFloats(n), AlignedFloats(n), AlignedFloats(n), {}};
  set.multiplicity.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double radius = std::sqrt(1 - lattice.depth[i]);
    set.x[i] = static_cast<float>(radius * lattice.cos_azimuth[i]);
    set.y[i] = static_cast<float>(radius * lattice.sin_azimuth[i]);
    set.z[i] = static_cast<float>(std::sqrt(lattice.depth[i]));
    set.multiplicity[i] = static_cast<std::int32_t>(2 * i + 1);
  }
  return set;
}

std::vector<Eigen::Vector3d> fibonacci_directions(std::size_t count) {
  std::vector<Eigen::Vector3d> directions(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double z = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double azimuth =
        2 * std::numbers::pi * std::fmod(static_cast<double>(i) / std::numbers::phi, 1);
    const double radius = std::sqrt((1 - z) * (1 + z));
    directions[i] = {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
  }
  return directions;
}

std::vector<Eigen::Vector3d> turned_directions(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  // Uniform on the unit quaternions, and so on the rotations.
  Eigen::Vector4d quaternion;
  for (double& component : quaternion)
    component = random.normal();
  const Eigen::Matrix3d rotation(Eigen::Quaterniond(quaternion.normalized()));
  std::vector<Eigen::Vector3d> directions = fibonacci_directions(count);
  for (Eigen::Vector3d& direction : directions)
    direction = rotation * direction;
  return directions;
}

AlignedFloats crease_distances(const CosineSet& cosines, const Creases& creases) {
  AlignedFloats u(cosines.size());
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] = static_cast<float>(crease_distance({cosines.x[i], cosines.y[i], cosines.z[i]}, creases));
  return u;
}

std::vector<Eigen::Vector3f> in_float(const std::vector<Eigen::Vector3d>& directions) {
  std::vector<Eigen::Vector3f> result;
  for (const Eigen::Vector3d& direction : directions)
    result.push_back(direction.cast<float>());
  return result;
}

}  // namespace ltc
