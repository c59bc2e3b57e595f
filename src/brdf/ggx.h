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

#include "brdf/lobe.h"

namespace ltc {

// The normal distribution function D, equation (4). `omega_h` need not have unit length; zero below
// the horizon.
double ggx_ndf(double alpha_x, double alpha_y, const Eigen::Vector3d& omega_h);

// Lambda, equation (5), free of cancellation. Infinite at the horizon; even in z.
double ggx_lambda(double alpha_x, double alpha_y, const Eigen::Vector3d& omega);

// Masking G1 = 1/(1 + Lambda) of one direction, and G2 of equation (5) of two.
double ggx_g1(double alpha_x, double alpha_y, const Eigen::Vector3d& omega);
double ggx_g2(double alpha_x, double alpha_y, const Eigen::Vector3d& omega_v,
              const Eigen::Vector3d& omega_l);

// One light direction that a view direction and a microfacet normal give.
struct GgxSample {
  // omega_l - mirror, accurate relative to the width of the lobe however sharp it is.
  Eigen::Vector3d offset;
  Eigen::Vector3d omega_l;
  double v_dot_h = 0;  // cosine between the view direction and the microfacet normal
  // G2/G1 = (1 + Lambda(v))/(1 + Lambda(v) + Lambda(l)) in [0, 1]: what remains to weight a visible
  // normal's reflection with. Zero below the horizon.
  double weight = 0;
};

// Evaluates and samples one lobe; keeps what only depends on the view.
class GgxSampler {
 public:
  explicit GgxSampler(const Lobe& lobe);

  const Eigen::Vector3d& omega_v() const { return omega_v_; }
  // Where a smooth surface would reflect to: (-vx, -vy, vz).
  const Eigen::Vector3d& mirror() const { return mirror_; }

  // The cosine-weighted BRDF with F = 1, equation (6), at a light direction; zero below the
  // horizon. `brdf_cosine_at_offset` takes the light direction relative to the mirror direction,
  // which loses no digits in lobes as narrow as 1e-6.
  double brdf_cosine(const Eigen::Vector3d& omega_l) const;
  double brdf_cosine_at_offset(const Eigen::Vector3d& offset) const;

  // Density of the light directions that reflections about visible normals have, before any is
  // weighted or rejected: D_v(h)/(4 v.h) = G1(v) D(h)/(4 cos theta_v). Some of it is below the
  // horizon.
  double vndf_density(const Eigen::Vector3d& omega_l) const;
  double vndf_density_at_offset(const Eigen::Vector3d& offset) const;

  // A visible microfacet normal from two uniforms on [0, 1): u_azimuth turns about the pole of the
  // spherical cap of Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps",
  // u_height goes from its pole to its rim. The map is continuous in both, periodic in u_azimuth.
  Eigen::Vector3d visible_normal(double u_azimuth, double u_height) const;
  // The same with the cosine and sine of 2 pi u_azimuth given.
  Eigen::Vector3d visible_normal(double cos_azimuth, double sin_azimuth, double u_height) const;

  // Reflects the view direction about a unit microfacet normal on or above the horizon.
  GgxSample reflect(const Eigen::Vector3d& omega_h) const;

  // A light direction by reflection about a visible normal; to be weighted by `weight`.
  GgxSample sample_visible(double u_azimuth, double u_height) const {
    return reflect(visible_normal(u_azimuth, u_height));
  }

  // A light direction with density proportional to the cosine-weighted BRDF: algorithm 1.
  // `uniform()` returns independent uniforms on [0, 1).
  template <class Uniform>
  GgxSample sample_rejection(Uniform&& uniform) const {
    for (;;) {
      const double u_azimuth = uniform();
      const double u_height = uniform();
      const GgxSample sample = sample_visible(u_azimuth, u_height);
      if (uniform() < sample.weight)
        return sample;
    }
  }

 private:
  double brdf_cosine_of(const Eigen::Vector3d& half, const Eigen::Vector3d& omega_l) const;

  double alpha_x_, alpha_y_;
  Eigen::Vector3d omega_v_, mirror_;
  Eigen::Vector3d stretched_v_;  // omega_v stretched to unit roughness, of unit length
  double one_minus_stretched_z_;
  double lambda_v_;              // Lambda(omega_v)
  double vz_one_plus_lambda_v_;  // vz (1 + Lambda(omega_v)), finite at the horizon too
};

}  // namespace ltc
