// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The anisotropic GGX microfacet lobe: Walter et al. 2007 ("Microfacet Models for Refraction
// through Rough Surfaces"), in the anisotropic form of Heitz 2014, as in equations (3) to (6) of
// Aakash et al. 2022, "Bringing Linearly Transformed Cosines to Anisotropic GGX".
//
// Equation numbers below are those of Aakash et al. 2022. Directions are unit vectors of the
// tangent frame: z is the surface normal, x the direction of alpha_x. Densities are per steradian.
#pragma once

#include <Eigen/Core>

#include "brdf/lobe_model.h"
#include "brdf/microfacet.h"

namespace ltc {

// The normal distribution function D, equation (4). `omega_h` need not have unit length; zero below
// the horizon.
double ggx_ndf(double alpha_x, double alpha_y, const Eigen::Vector3d& omega_h);

// Lambda, equation (5), free of cancellation. Infinite at the horizon; even in z.
double ggx_lambda(double alpha_x, double alpha_y, const Eigen::Vector3d& omega);

// Evaluates (equation 6) and samples one lobe; keeps what only depends on the view.
class GgxSampler final : public MicrofacetSampler<GgxSampler, ggx_ndf, ggx_lambda> {
 public:
  explicit GgxSampler(const Lobe& lobe);

  // A visible microfacet normal from two uniforms on [0, 1): u_azimuth, given by the cosine and
  // sine of as many turns, turns about the pole of the spherical cap of Dupuy and Benyoub 2023,
  // "Sampling Visible GGX Normals with Spherical Caps", u_height goes from its pole to its rim. The
  // map is continuous in both, periodic in u_azimuth.
  Eigen::Vector3d visible_normal(double cos_azimuth, double sin_azimuth, double u_height) const;

  // Reflects the view direction about a unit microfacet normal on or above the horizon.
  LobeSample reflect(const Eigen::Vector3d& omega_h) const { return weighted(omega_h); }

  using LobeSampler::sample;
  LobeSample sample(double cos_azimuth, double sin_azimuth, double u_height) const override {
    return reflect(visible_normal(cos_azimuth, sin_azimuth, u_height));
  }

 private:
  Eigen::Vector3d stretched_v_;  // omega_v stretched to unit roughness, of unit length
  double one_minus_stretched_z_;
};
extern template class MicrofacetSampler<GgxSampler, ggx_ndf, ggx_lambda>;

// The model, with kernels of its own.
const LobeModel& ggx();

}  // namespace ltc
