// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The anisotropic Beckmann microfacet lobe: slopes of a normal distribution (Beckmann and
// Spizzichino 1963), of variance alpha_x^2/2 and alpha_y^2/2, with the masking of Smith 1967 and
// the height-correlated masking and shadowing of Heitz 2014, "Understanding the Masking-Shadowing
// Function in Microfacet-Based BRDFs". Directions and units are those of brdf/ggx.h.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "brdf/lobe_model.h"
#include "brdf/microfacet.h"

namespace ltc {

// D = exp(-(hx/ax)^2/hz^2 - (hy/ay)^2/hz^2) / (pi ax ay hz^4). `omega_h` need not have unit length;
// zero below the horizon.
double beckmann_ndf(double alpha_x, double alpha_y, const Eigen::Vector3d& omega_h);

// Lambda = (exp(-a^2)/(a sqrt(pi)) - erfc(a))/2, a = |z|/sqrt((ax x)^2 + (ay y)^2). Infinite at the
// horizon; even in z.
double beckmann_lambda(double alpha_x, double alpha_y, const Eigen::Vector3d& omega);

// Evaluates and samples one lobe.
//
// With slopes scaled to unit roughness and turned so that the view is (s, 0, c), the visible
// normals (X, Y, 1) have the density (c + s X)+ exp(-X^2 - Y^2)/(pi c (1 + Lambda)): Y is normal,
// and so is X but for the factor (Heitz and d'Eon 2014). A point of the plane with two normal
// coordinates, by polar coordinates from the unit square, becomes one of them by a monotonic map of
// X alone. So the map from the square is continuous, periodic in the azimuth, and has the tails at
// the end of the heights.
class BeckmannSampler final
    : public MicrofacetSampler<BeckmannSampler, beckmann_ndf, beckmann_lambda> {
 public:
  explicit BeckmannSampler(const Lobe& lobe);

  using LobeSampler::sample;
  LobeSample sample(double cos_azimuth, double sin_azimuth, double u_height) const override;

  // Of the map below, evenly from -6 to 6.
  static constexpr int knots_a_unit = 8, last_knot = 6 * knots_a_unit;

  // Of one sample's slopes and weight, what the kernels need of a lobe beside its directions.
  struct SlopeMap {
    static constexpr int cells = 2 * last_knot;  // between the knots
    // Of each cell the coefficients of a polynomial in the place within it, power by power.
    std::array<std::array<float, cells>, 6> coefficients;
    double along_x, along_y;  // the azimuth of the stretched view
    double one_plus_lambda_v;
  };
  SlopeMap slope_map() const;

  // The map: where the visible slopes' distribution has the mass below that the normal one has
  // below X. Increasing, within 1e-8 of exact.
  double visible_slope(double normal_slope) const;

 private:
  // The map at a knot, and its derivatives times the knots' distance and its square.
  using Knot = std::array<double, 3>;

  void tabulate();

  double s_, c_;              // of the stretched view, of unit length
  double along_x_, along_y_;  // its azimuth
  std::array<Knot, 2 * last_knot + 1> knots_;
};
extern template class MicrofacetSampler<BeckmannSampler, beckmann_ndf, beckmann_lambda>;

const LobeModel& beckmann();

}  // namespace ltc
