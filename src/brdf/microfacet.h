// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the lobes of microfacets have in common, whatever their normals are distributed by: the
// reflected density D G/(4 cos theta_v cos theta_l) with the height-correlated masking and
// shadowing G = 1/(1 + Lambda(v) + Lambda(l)) of Smith's Lambda.
#pragma once

#include <Eigen/Core>

#include "brdf/lobe_sampler.h"

namespace ltc {

// D of a direction that need not have unit length, and Lambda of a direction; both of alpha_x and
// alpha_y. Model::sample is what it draws.
template <class Model, auto ndf, auto lambda>
class MicrofacetSampler : public LobeSampler {
 public:
  // The cosine-weighted BRDF, and the density of reflections about visible normals, D_v(h)/(4 v.h)
  // = D(h)/(4 vz (1 + Lambda(v))).
  LobeDensities densities(const Eigen::Vector3d& omega_l) const override;
  LobeDensities densities_at_offset(const Eigen::Vector3d& offset) const override;
  void sample_all(const SampleLattice& lattice, WeightedSamples& samples) const override;

 protected:
  // `vz_one_plus_lambda_v` = vz (1 + Lambda(v)), finite at the horizon too.
  MicrofacetSampler(const Lobe& lobe, double vz_one_plus_lambda_v)
      : LobeSampler(lobe.omega_v()),
        alpha_x_(lobe.alpha_x),
        alpha_y_(lobe.alpha_y),
        lambda_v_(lambda(alpha_x_, alpha_y_, omega_v())),
        vz_one_plus_lambda_v_(vz_one_plus_lambda_v) {}

  double alpha_x() const { return alpha_x_; }
  double alpha_y() const { return alpha_y_; }
  double lambda_v() const { return lambda_v_; }

  // The view reflected about a visible normal on or above the horizon, of the weight G2/G1 =
  // (1 + Lambda(v))/(1 + Lambda(v) + Lambda(l)).
  LobeSample weighted(const Eigen::Vector3d& omega_h) const;

 private:
  LobeDensities densities_of(const Eigen::Vector3d& half, const Eigen::Vector3d& omega_l) const;

  double alpha_x_, alpha_y_;
  double lambda_v_;
  double vz_one_plus_lambda_v_;
};

}  // namespace ltc
