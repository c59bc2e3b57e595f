// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The fixed low-discrepancy sets of the fit: cosine samples, the GGX target's lattice, directions.
//
// Fixed sets make the fit a deterministic function of its input and let every entry share them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/aligned.h"

namespace ltc {

// Clamped-cosine directions, structure of arrays. Sizes are multiples of 16; all samples weigh the
// same.
struct CosineSet {
  AlignedFloats x, y, z;
  std::size_t size() const { return x.size(); }
};
// `count` (rounded up to a multiple of 16) samples of a golden-ratio lattice; `shift` turns the
// lattice by that share of a circle: sets with different shifts share no samples.
CosineSet make_cosine_set(std::size_t count, double shift = 0.0);

// A rank-1 lattice on the unit square, as the VNDF sampler wants it: (cos, sin)(2 pi u1) and u2.
struct TargetLattice {
  AlignedFloats cos_azimuth, sin_azimuth, height;
  std::size_t size() const { return height.size(); }
};
TargetLattice make_target_lattice(std::size_t count, double shift = 0.0);

// Spherical Fibonacci directions on the upper hemisphere; the lower one adds nothing, since d and
// -d see the same distance.
std::vector<Eigen::Vector3d> fibonacci_directions(std::size_t count);

// Directions uniform on the sphere from a seeded generator.
std::vector<Eigen::Vector3d> random_directions(std::size_t count, std::uint64_t seed);

// The same directions as the kernels take them.
std::vector<Eigen::Vector3f> in_float(const std::vector<Eigen::Vector3d>& directions);

}  // namespace ltc
