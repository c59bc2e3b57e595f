// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Weighted lattice samples of a GGX lobe.
#include "brdf/ggx_lattice.h"

#include <cmath>
#include <numbers>

namespace ltc {

VisibleNormalLattice::VisibleNormalLattice(std::size_t count, double azimuth_shift,
                                           double height_shift)
    : cos_azimuth_(static_cast<Eigen::Index>(count)),
      sin_azimuth_(static_cast<Eigen::Index>(count)),
      u_height_(static_cast<Eigen::Index>(count)) {
  const double golden = std::numbers::phi - 1;
  for (Eigen::Index i = 0; i < u_height_.size(); ++i) {
    const double turns = golden * static_cast<double>(i) + azimuth_shift;
    const double azimuth = 2 * std::numbers::pi * (turns - std::floor(turns));
    cos_azimuth_[i] = std::cos(azimuth);
    sin_azimuth_[i] = std::sin(azimuth);
    const double height =
        (static_cast<double>(i) + 0.5) / static_cast<double>(count) + height_shift;
    u_height_[i] = height < 1 ? height : height - 1;
  }
}

void sample_weighted(const Lobe& lobe, const VisibleNormalLattice& lattice,
                     WeightedSamples& samples) {
  const GgxSampler sampler(lobe);
  const auto count = static_cast<Eigen::Index>(lattice.size());
  samples.offset.resize(count, 3);
  samples.weight.resize(count);
  samples.mirror = sampler.mirror();
  for (Eigen::Index i = 0; i < count; ++i) {
    const GgxSample sample = sampler.reflect(sampler.visible_normal(
        lattice.cos_azimuth()[i], lattice.sin_azimuth()[i], lattice.u_height()[i]));
    samples.offset.row(i) = sample.offset.transpose();
    samples.weight[i] = sample.weight;
  }
}

}  // namespace ltc
