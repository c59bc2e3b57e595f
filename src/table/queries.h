// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a renderer asks a table for: lobes between the nodes, drawn from a stated distribution.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "brdf/lobe.h"

namespace ltc {

// Lobes whose perceptual roughness sqrt(alpha), lambda, cos(theta) and phi are independent and
// uniform between the bounds, alpha = alpha_x being the larger roughness and lambda = alpha_y /
// alpha_x.
struct QueryRange {
  double roughness_first = 0.1, roughness_last = 1;  // perceptual, within [0, 1]
  double lambda_first = 0, lambda_last = 1;
  double cos_theta_first = 0, cos_theta_last = 1;
  double phi_first = 0, phi_last = 1.5707963267948966;  // radians

  bool operator==(const QueryRange&) const = default;
};

// The lobe at four uniform numbers in [0, 1), for roughness, lambda, cos(theta) and phi in this
// order; each alpha is at least `alpha_min`.
Lobe query_lobe(const QueryRange& range, const std::array<double, 4>& uniforms, double alpha_min,
                const LobeModel& model = ggx());

// `count` independent queries; the same seed gives the same ones.
std::vector<Lobe> random_queries(const QueryRange& range, std::size_t count, std::uint64_t seed,
                                 double alpha_min, const LobeModel& model = ggx());

// Points first .. first + count - 1 of a low-discrepancy sequence in four dimensions, the additive
// recurrence of Roberts' generalised golden ratio; and the queries there, for sums over many.
std::vector<std::array<double, 4>> lattice_points(std::size_t first, std::size_t count);
std::vector<Lobe> lattice_queries(const QueryRange& range, std::size_t first, std::size_t count,
                                  double alpha_min, const LobeModel& model = ggx());

}  // namespace ltc
