// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// For the files that instantiate it, where D and Lambda are inlined.
#pragma once

#include "brdf/microfacet.h"

namespace ltc {

template <class Model, auto ndf, auto lambda>
LobeDensities MicrofacetSampler<Model, ndf, lambda>::densities_of(
    const Eigen::Vector3d& half, const Eigen::Vector3d& omega_l) const {
  const double density = ndf(alpha_x_, alpha_y_, half);
  LobeDensities densities{0, density / (4 * vz_one_plus_lambda_v_)};
  // G2/cos theta_v = 1/(vz (1 + Lambda(v) + Lambda(l))).
  if (omega_l.z() > 0)
    densities.brdf_cosine =
        density /
        (4 * (vz_one_plus_lambda_v_ + omega_v().z() * lambda(alpha_x_, alpha_y_, omega_l)));
  return densities;
}

template <class Model, auto ndf, auto lambda>
LobeDensities MicrofacetSampler<Model, ndf, lambda>::densities(
    const Eigen::Vector3d& omega_l) const {
  return densities_of(omega_v() + omega_l, omega_l);
}

template <class Model, auto ndf, auto lambda>
LobeDensities MicrofacetSampler<Model, ndf, lambda>::densities_at_offset(
    const Eigen::Vector3d& offset) const {
  return densities_of({offset.x(), offset.y(), 2 * omega_v().z() + offset.z()}, axis() + offset);
}

template <class Model, auto ndf, auto lambda>
LobeSample MicrofacetSampler<Model, ndf, lambda>::weighted(const Eigen::Vector3d& omega_h) const {
  LobeSample sample = reflected(omega_h);
  if (sample.omega_l.z() > 0)
    sample.weight = (1 + lambda_v_) / (1 + lambda_v_ + lambda(alpha_x_, alpha_y_, sample.omega_l));
  return sample;
}

template <class Model, auto ndf, auto lambda>
void MicrofacetSampler<Model, ndf, lambda>::sample_all(const SampleLattice& lattice,
                                                       WeightedSamples& samples) const {
  const auto& model = static_cast<const Model&>(*this);
  fill(lattice, samples,
       [&](double c, double s, double u) { return model.Model::sample(c, s, u); });
}

}  // namespace ltc
