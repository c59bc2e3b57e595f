// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Samples of one distribution on the sphere against the density of another, in bins of height and
// azimuth.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "statistics.h"

namespace ltc::test {

// Bins, and how many points of the density there are in each, along either axis.
struct SphereBins {
  int heights = 16, azimuths = 24, subdivisions = 40;
};

template <typename Sampler, typename Density>
ChiSquared sampler_against(const Sampler& sampler, const Density& density,
                           const SphereBins& bins = {}) {
  constexpr int samples = 100'000;
  constexpr double pi = std::numbers::pi;
  std::vector<double> counts(static_cast<std::size_t>(bins.heights * bins.azimuths), 0.0),
      wanted = counts;
  const int heights = bins.heights * bins.subdivisions,
            azimuths = bins.azimuths * bins.subdivisions;
  const auto at = [&](int height, int azimuth) {
    return static_cast<std::size_t>(height * bins.azimuths + azimuth);
  };
  for (int i = 0; i < heights; ++i)
    for (int j = 0; j < azimuths; ++j) {
      const double z = 1 - 2 * (i + 0.5) / heights, azimuth = 2 * pi * (j + 0.5) / azimuths;
      const double sine = std::sqrt(1 - z * z);
      wanted[at(i / bins.subdivisions, j / bins.subdivisions)] +=
          samples * 4 * pi / (heights * azimuths) *
          density.density({sine * std::cos(azimuth), sine * std::sin(azimuth), z});
    }
  Uniform uniform(4);
  for (int i = 0; i < samples; ++i) {
    const double u_height = uniform();
    const Eigen::Vector3d omega = sampler.sample(u_height, uniform());
    const double turn = std::atan2(omega.y(), omega.x()) / (2 * pi);
    const int height =
        std::min(bins.heights - 1, static_cast<int>((1 - omega.z()) / 2 * bins.heights));
    const int azimuth =
        std::min(bins.azimuths - 1, static_cast<int>((turn - std::floor(turn)) * bins.azimuths));
    counts[at(height, azimuth)] += 1;
  }
  return chi_squared(counts, wanted);
}

}  // namespace ltc::test
