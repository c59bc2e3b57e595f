// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "brdf/lattice.h"

#include <numbers>

namespace ltc {

LatticePoint lattice_point(std::size_t i, std::size_t count, double shift, double place) {
  return {2 * std::numbers::pi * golden_turns(i, shift),
          (static_cast<double>(i) + place) / static_cast<double>(count)};
}

SampleLattice::SampleLattice(std::size_t count, double azimuth_shift, double height_shift) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto [azimuth, unshifted] = lattice_point(i, count, azimuth_shift);
    cos_azimuth.push_back(std::cos(azimuth));
    sin_azimuth.push_back(std::sin(azimuth));
    const double shifted = unshifted + height_shift;
    height.push_back(shifted < 1 ? shifted : shifted - 1);
  }
}

TargetLattice make_target_lattice(std::size_t count, double shift) {
  const std::size_t n = lattice_size(count);
  TargetLattice lattice{AlignedFloats(n), AlignedFloats(n), AlignedFloats(n)};
  for (std::size_t i = 0; i < n; ++i) {
    const auto [azimuth, height] = lattice_point(i, n, shift, place_of_slopes);
    lattice.cos_azimuth[i] = static_cast<float>(std::cos(azimuth));
    lattice.sin_azimuth[i] = static_cast<float>(std::sin(azimuth));
    lattice.height[i] = static_cast<float>(height);
  }
  return lattice;
}

GradedLattice make_graded_lattice(std::size_t count, double shift) {
  const std::size_t n = lattice_size(count);
  GradedLattice lattice;
  for (std::size_t i = 0; i < n; ++i) {
    const auto [azimuth, t] = lattice_point(i, n, shift);
    lattice.cos_azimuth.push_back(std::cos(azimuth));
    lattice.sin_azimuth.push_back(std::sin(azimuth));
    lattice.depth.push_back(t * t);
    lattice.mass.push_back(2 * t / static_cast<double>(n));
  }
  return lattice;
}

}  // namespace ltc
