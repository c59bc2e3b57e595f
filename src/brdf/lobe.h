// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// One lobe of a material: what light directions a viewer sees. Directions are unit vectors of the
// tangent frame: z is the surface normal, x the direction of alpha_x.
#pragma once

#include <Eigen/Core>

namespace ltc {

class LobeModel;         // brdf/lobe_model.h
const LobeModel& ggx();  // brdf/ggx.h

struct Lobe {
  double alpha_x = 1.0;        // > 0; meaningful down to 1e-12
  double alpha_y = 1.0;        // > 0; meaningful down to 1e-12
  double theta_radians = 0.0;  // elevation of the view direction, [0, pi/2)
  double phi_radians = 0.0;    // azimuth of the view direction
  const LobeModel* model = &ggx();

  // (sin theta cos phi, sin theta sin phi, cos theta), equation (3) of Aakash et al. 2022. A sine
  // or cosine of phi that is zero but for the rounding of phi is zero, so that a view along an axis
  // is exactly symmetric.
  Eigen::Vector3d omega_v() const;
  // Where a smooth surface would reflect to: (-vx, -vy, vz).
  Eigen::Vector3d mirror() const;
};

// The least rotation from z to the mirror direction (-vx, -vy, vz) of a unit view direction, vz >
// -1.
Eigen::Matrix3d mirror_rotation(const Eigen::Vector3d& omega_v);

}  // namespace ltc
