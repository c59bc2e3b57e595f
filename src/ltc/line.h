// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Integrals of the clamped cosine and of its linear transforms over lines with a width: Heitz and
// Hill 2017, "Linear-Light Shading with Linearly Transformed Cosines".
#pragma once

#include <Eigen/Core>

namespace ltc {

// The points between the ends, and those within `radius` of them at right angles to the line and to
// the view from the origin, in any unit of length: what a thin cylinder shows, without its ends.
struct Line {
  Eigen::Vector3d from, to;
  double radius;
};

// (R/pi) [(Fpo(d, l2) - Fpo(d, l1)) po_z + (Fwt(d, l2) - Fwt(d, l1)) wt_z] with
// Fpo = l/(d (d^2 + l^2)) + atan(l/d)/d^2 and Fwt = l^2/(d (d^2 + l^2)): the integral of z/pi
// d omega over the part at z >= 0. po is the point of the line's straight nearest the origin, d its
// distance, wt the direction, l from po. To first order in radius/d, the error of second: it may
// exceed 1 where the line is as wide as it is near. Zero for a line that leads through the origin.
// Throws InputError for what is not finite and for a radius that is not positive.
double clamped_cosine_share(const Line& line);

// The share of a clamped cosine's transform by M (ltc/ltsd.h) on the line, which is cut off at the
// surface's horizon before the transform and at that of the cosine after it. The transformed line
// is 1/|M^T n| times as wide, with n the unit normal of the plane through line and origin. Throws
// InputError for a matrix without an inverse too.
double ltc_share(const Eigen::Matrix3d& matrix, const Line& line);

}  // namespace ltc
