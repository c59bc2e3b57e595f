// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Weighted lattice samples of a GGX lobe: reflections about visible normals on a two-dimensional
// lattice, weighted by G2/G1 instead of kept or rejected by algorithm 1.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "brdf/ggx.h"

namespace ltc {

// Points of the unit square that any lobe's samples are made from: the golden-ratio lattice
// (frac(i (sqrt 5 - 1)/2), (i + 1/2)/count), which covers the cap of visible normals evenly for
// every count. Lattices shifted on the torus by independent uniforms are independent estimates.
class VisibleNormalLattice {
 public:
  // `count` >= 1 points; the shifts are in [0, 1).
  explicit VisibleNormalLattice(std::size_t count, double azimuth_shift = 0,
                                double height_shift = 0);

  std::size_t size() const { return static_cast<std::size_t>(u_height_.size()); }
  const Eigen::ArrayXd& cos_azimuth() const { return cos_azimuth_; }
  const Eigen::ArrayXd& sin_azimuth() const { return sin_azimuth_; }
  const Eigen::ArrayXd& u_height() const { return u_height_; }

 private:
  Eigen::ArrayXd cos_azimuth_, sin_azimuth_, u_height_;
};

// Light directions of a lobe. The distribution is proportional to the cosine-weighted BRDF when
// each is counted with its weight.
struct WeightedSamples {
  Eigen::ArrayX3d offset;  // omega_l - mirror, one row a sample, columns x, y, z contiguous
  Eigen::ArrayXd weight;   // G2/G1 in [0, 1], zero below the horizon; their mean is the amplitude
  Eigen::Vector3d mirror;  // (-vx, -vy, vz): omega_l = mirror + offset
};

// One sample a lattice point. Reuses the memory of `samples`.
void sample_weighted(const Lobe& lobe, const VisibleNormalLattice& lattice,
                     WeightedSamples& samples);

}  // namespace ltc
