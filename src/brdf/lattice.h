// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The golden-ratio lattice on the unit square, which lobes are sampled on: point i of n is
// (frac(i (sqrt 5 - 1)/2 + shift), (i + place)/n), azimuth in turns and height. It covers the
// square evenly for every n, and lattices of independent shifts are independent estimates.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/aligned.h"

namespace ltc {

inline double golden_turns(std::size_t i, double shift = 0) {
  constexpr double golden = 0.61803398874989484820;
  const double turns = shift + static_cast<double>(i) * golden;
  return turns - std::floor(turns);
}

struct LatticePoint {
  double azimuth_radians, height;
};
LatticePoint lattice_point(std::size_t i, std::size_t count, double shift = 0, double place = 0.5);

// The mean slope of a sharp lobe is an integral of (1 - u)^(-1/2) over the heights, for cosine
// samples as for the target's, and only here has its sum over n samples no error of the order
// n^(-1/2) (1 - 0.697 is the zero of Hurwitz's zeta(1/2, a)). At 0.92 the outermost sample alone
// makes the lobe 1.6 % too wide for n = 4096.
inline constexpr double place_of_slopes = 0.6973;

// The multiple of 16 that the kernels want.
inline std::size_t lattice_size(std::size_t count) {
  return (count + 15) / 16 * 16;
}

// In double precision, `count` >= 1 points. `height_shift` in [0, 1) wraps around.
struct SampleLattice {
  explicit SampleLattice(std::size_t count, double azimuth_shift = 0, double height_shift = 0);
  std::size_t size() const { return height.size(); }

  std::vector<double> cos_azimuth, sin_azimuth, height;
};

// For the kernels: in single precision, lattice_size(count) points at place_of_slopes.
struct TargetLattice {
  AlignedFloats cos_azimuth, sin_azimuth, height;
  std::size_t size() const { return height.size(); }
};
TargetLattice make_target_lattice(std::size_t count, double shift = 0.0);

// Heights so graded that the heavy tails of sharp lobes, which are made of the samples with heights
// near 1, have as many of them as all the rest: the depth 1 - height is t^2 with t evenly spaced.
// Point i of n has the mass (2 i + 1)/n^2, which is exactly that of its cell. As depths, for single
// precision could not tell heights from 1.
struct GradedLattice {
  std::vector<double> cos_azimuth, sin_azimuth, depth, mass;
  std::size_t size() const { return depth.size(); }
};
GradedLattice make_graded_lattice(std::size_t count, double shift = 0.0);

}  // namespace ltc
