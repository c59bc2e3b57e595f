// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How much light a lobe reflects in all: the amplitude and Fresnel channels of a table.
#pragma once

#include <cstddef>
#include <vector>

#include "brdf/lobe.h"

namespace ltc {

// The two integrals over light directions that shading adds to the LTC, both in [0, 1]:
// F0 amplitude + (1 - F0) fresnel is the albedo under Schlick's Fresnel term.
struct Albedo {
  double amplitude = 0;  // integral of rho cos(theta_l) with F = 1
  double fresnel = 0;    // integral of (1 - v.h)^5 rho cos(theta_l)
};

// Nodes and weights of a quadrature over the unit square that a lobe's samples are made from
// (LobeSampler::sample). The golden-ratio lattice: periodic in the azimuth, and made
// periodic in the height by u = t^2 (3 - 2 t) with weight 6 t (1 - t), which vanishes at both ends.
class AlbedoRule {
 public:
  // With this many points the largest absolute error over the 4096 nodes of the paper's grid is
  // 6.9e-5 (amplitude; 99th percentile 3.1e-5, median 2.2e-6) and 2.1e-5 (fresnel), against 2^18
  // points. The bound that holds and is tested is 1e-4.
  static constexpr std::size_t default_points = 12288;

  // `points` >= 1 is rounded up to a multiple of block_size.
  explicit AlbedoRule(std::size_t points = default_points);

  // Points are summed in blocks of this size whatever the vector length of the processor, so that
  // the sums have the same bits everywhere.
  static constexpr std::size_t block_size = 16;

  std::size_t size() const { return weight.size(); }

  std::vector<float> cos_azimuth, sin_azimuth;
  std::vector<float> height, one_minus_height;  // u_height and 1 - u_height, both to all digits
  std::vector<float> weight;                    // sums to 1
};

// Both integrals of a lobe by the rule; for GGX in single precision with the sums in double.
Albedo integrate_albedo(const Lobe& lobe, const AlbedoRule& rule);

}  // namespace ltc
