// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The fixed low-discrepancy sets of the fit: cosine samples and directions; brdf/lattice.h has
// those of the target.
//
// Fixed sets make the fit a deterministic function of its input and let every entry share them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "brdf/lattice.h"
#include "core/aligned.h"
#include "ltc/folded.h"
#include "ltc/horizon.h"

namespace ltc {

// Clamped-cosine directions, structure of arrays. Sizes are multiples of 16.
struct CosineSet {
  AlignedFloats x, y, z;
  // What each sample counts; empty where all weigh the same.
  AlignedVector<std::int32_t> multiplicity;
  // Scaled: what a lobe takes below the horizon counts nothing.
  HorizonMode horizon = HorizonMode::clipped;
  std::size_t size() const { return x.size(); }
  std::size_t total() const;  // of the multiplicities
};
std::size_t total_of(const AlignedVector<std::int32_t>& multiplicity, std::size_t samples);
// `count` (rounded up to a multiple of 16) samples of a golden-ratio lattice; `shift` turns the
// lattice by that share of a circle: sets with different shifts share no samples.
CosineSet make_cosine_set(std::size_t count, double shift = 0.0);

// The same on a graded lattice: point i of n counts 2 i + 1 of n^2.
CosineSet make_graded_cosine_set(std::size_t count);

// Of every sample the u of a fold (ltc/folded.h).
AlignedFloats crease_distances(const CosineSet& cosines, const Creases& creases);

// Spherical Fibonacci directions on the upper hemisphere; the lower one adds nothing, since d and
// -d see the same distance.
std::vector<Eigen::Vector3d> fibonacci_directions(std::size_t count);

// The same, turned as a whole by a random rotation: for every seed an unbiased set, with an eighth
// of the error that as many independent directions have.
std::vector<Eigen::Vector3d> turned_directions(std::size_t count, std::uint64_t seed);

// The same directions as the kernels take them.
std::vector<Eigen::Vector3f> in_float(const std::vector<Eigen::Vector3d>& directions);

}  // namespace ltc
