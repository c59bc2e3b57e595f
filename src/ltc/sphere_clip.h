// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The horizon's share of a sphere's light, which shaders of isotropic tables take from the second
// texture's last channel to clip polygons without clipping them.
#pragma once

namespace ltc {

// The cosine-weighted integral over the upper hemisphere of a sphere seen in a direction of
// `cos_omega` to the normal, over that of the same sphere unclipped in the direction of the normal.
// `form_factor` = sin(sigma)^2 in [0, 1], sigma being the sphere's angular radius: the length of
// the vector that a polygon's edges sum up to. Equals cos_omega where the sphere is above the
// horizon, 0 where it is below. Equations of Snyder, Area Light Sources for Real-Time Graphics,
// 1996.
double clipped_sphere_factor(double cos_omega, double form_factor);

}  // namespace ltc
