// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/sample_sets.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/random.h"

namespace ltc {
namespace {

double fraction(double value) {
  return value - std::floor(value);
}

std::size_t rounded_up(std::size_t count) {
  return (count + 15) / 16 * 16;
}

// The mean slope of a sharp lobe is an integral of (1 - u)^(-1/2) over the heights, for cosine
// samples as for the target's, and only here has its sum over n samples no error of the order
// n^(-1/2) (1 - 0.697 is the zero of Hurwitz's zeta(1/2, a)). At 0.92 the outermost sample alone
// makes the lobe 1.6 % too wide for n = 4096.
constexpr double place_in_stratum = 0.6973;

// Point i of n: the azimuth steps by the golden ratio, the height runs through n strata and stands
// at the same place in each.
struct LatticePoint {
  double azimuth, height;
};
LatticePoint lattice_point(std::size_t i, std::size_t n, double shift) {
  constexpr double golden = 0.61803398874989484820;
  const double height = (static_cast<double>(i) + place_in_stratum) / static_cast<double>(n);
  const double azimuth = fraction(shift + static_cast<double>(i) * golden);
  return {2 * std::numbers::pi * azimuth, height};
}

}  // namespace

CosineSet make_cosine_set(std::size_t count, double shift) {
  const std::size_t n = rounded_up(count);
  CosineSet set{AlignedFloats(n), AlignedFloats(n), AlignedFloats(n), {}};
  for (std::size_t i = 0; i < n; ++i) {
    const auto [azimuth, height] = lattice_point(i, n, shift);
    const double radius = std::sqrt(height);
    set.x[i] = static_cast<float>(radius * std::cos(azimuth));
    set.y[i] = static_cast<float>(radius * std::sin(azimuth));
    set.z[i] = static_cast<float>(std::sqrt(1 - height));
  }
  return set;
}

TargetLattice make_target_lattice(std::size_t count, double shift) {
  const std::size_t n = rounded_up(count);
  TargetLattice lattice{AlignedFloats(n), AlignedFloats(n), AlignedFloats(n)};
  for (std::size_t i = 0; i < n; ++i) {
    const auto [azimuth, height] = lattice_point(i, n, shift);
    lattice.cos_azimuth[i] = static_cast<float>(std::cos(azimuth));
    lattice.sin_azimuth[i] = static_cast<float>(std::sin(azimuth));
    lattice.height[i] = static_cast<float>(height);
  }
  return lattice;
}

std::size_t CosineSet::total() const {
  std::size_t sum = multiplicity.empty() ? size() : 0;
  for (const std::int32_t count : multiplicity)
    sum += static_cast<std::size_t>(count);
  return sum;
}

GradedLattice make_graded_lattice(std::size_t count) {
  const std::size_t n = rounded_up(count);
  GradedLattice lattice;
  for (std::size_t i = 0; i < n; ++i) {
    const double azimuth = lattice_point(i, n, 0.0).azimuth;
    const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    lattice.cos_azimuth.push_back(std::cos(azimuth));
    lattice.sin_azimuth.push_back(std::sin(azimuth));
    lattice.depth.push_back(t * t);
    lattice.mass.push_back(2 * t / static_cast<double>(n));
  }
  return lattice;
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
        2 * std::numbers::pi * fraction(static_cast<double>(i) / std::numbers::phi);
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

std::vector<Eigen::Vector3f> in_float(const std::vector<Eigen::Vector3d>& directions) {
  std::vector<Eigen::Vector3f> result;
  for (const Eigen::Vector3d& direction : directions)
    result.push_back(direction.cast<float>());
  return result;
}

}  // namespace ltc
