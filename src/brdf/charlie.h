// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The sheen of cloth, as glTF's KHR_materials_sheen has it: Estevez and Kulla 2017, "Production
// Friendly Microfacet Sheen BRDF". Fibres stand up from the surface, so that light comes back
// from near the horizon, and there is no mirror-like lobe. Isotropic. The parameter r of the paper,
// sheenRoughness squared, is a table's alpha.
#pragma once

#include <Eigen/Core>

#include "brdf/light_cells.h"
#include "brdf/lobe_model.h"
#include "brdf/lobe_sampler.h"

namespace ltc {

// What of the light gets in and out between the fibres.
enum class SheenVisibility {
  charlie,    // the paper's fit to shadowing by Smith, 1/((1 + Lambda(v) + Lambda(l)) 4 vz lz)
  ashikhmin,  // Ashikhmin and Premoze 2007, 1/(4 (vz + lz - vz lz)): engines' cheaper one
};

// D = (2 + 1/alpha) sin(theta_h)^(1/alpha)/(2 pi). `omega_h` need not have unit length.
double charlie_ndf(double alpha, const Eigen::Vector3d& omega_h);

// The paper's table 1 and equation (3), of |cos theta|; its softening of the terminator, which
// would not be the same with view and light exchanged, is left out as glTF does.
double charlie_lambda(double alpha, double cosine);

// Light directions by their density on a grid that is dense at the horizon, weighted by the BRDF.
// Offsets are counted from the normal, in the frame of the tangent plane.
class CharlieSampler final : public LobeSampler {
 public:
  CharlieSampler(const Lobe& lobe, SheenVisibility visibility);

  LobeDensities densities(const Eigen::Vector3d& omega_l) const override;
  double most_weight() const override { return most_weight_; }

  // With about half as many directions as `points`, twice as many of them along the azimuth's half
  // turn as along the height.
  Albedo albedo(std::size_t points) const;

  using LobeSampler::sample;
  LobeSample sample(double cos_azimuth, double sin_azimuth, double u_height) const override;

 private:
  double brdf_cosine_of(const Eigen::Vector3d& omega_l) const;
  Eigen::Vector3d direction(double height, double azimuth) const;
  LightCells cells() const;

  SheenVisibility visibility_;
  double alpha_, lambda_v_;
  Eigen::Vector2d along_;  // the view's azimuth, from which that of light is counted
  LightCells cells_;
  double most_weight_;
};

// Both models, "charlie" and "charlie-ashikhmin". Lobes of alpha below least_sheen_alpha, or of two
// roughnesses, are refused: seen from above their light is no number any more, and reflected by
// nobody.
inline constexpr double least_sheen_alpha = 1e-3;
const LobeModel& charlie(SheenVisibility visibility = SheenVisibility::charlie);

}  // namespace ltc
