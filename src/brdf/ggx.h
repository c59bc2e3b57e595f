// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The anisotropic GGX microfacet lobe: Walter et al. 2007 ("Microfacet Models for Refraction through
// Rough Surfaces"), in the anisotropic form of Heitz 2014, as in equations (3) to (6) of
// Aakash et al. 2022, "Bringing Linearly Transformed Cosines to Anisotropic GGX".
#pragma once

#include <Eigen/Core>

namespace ltc {

// One lobe: what light directions a viewer sees. Tangent frame: z is the surface normal, x the
// direction of alpha_x.
struct GgxLobe {
  double alpha_x = 1.0;        // > 0; meaningful down to 1e-6
  double alpha_y = 1.0;        // > 0; meaningful down to 1e-6
  double theta_radians = 0.0;  // elevation of the view direction, [0, pi/2)
  double phi_radians = 0.0;    // azimuth of the view direction

  // (sin theta cos phi, sin theta sin phi, cos theta), equation (3).
  Eigen::Vector3d omega_v() const;
};

}  // namespace ltc
