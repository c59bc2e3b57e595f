// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Exact integrals of the clamped cosine over ellipses and spheres seen from the origin, and of its
// linear transforms: the closed form of Heitz and Hill 2017, "Real-Time Line- and Disk-Light
// Shading with Linearly Transformed Cosines", without their approximation of the horizon.
//
// E = 1/(2 pi) closed integral of (p x dp)_z/|p|^2 along the rim p(t). An ellipse has no sides:
// shares are not negative. One whose plane contains the origin has the share 0.
#pragma once

#include <Eigen/Core>
#include <span>

namespace ltc {

// The points center + x half_u + y half_v, x^2 + y^2 <= 1, in any unit of length. The half axes
// need be neither perpendicular nor of one length: the transform of an ellipse is one.
struct Ellipse {
  Eigen::Vector3d center, half_u, half_v;
};

// The disk that covers what a sphere covers, seen from the origin: centre c (1 - r^2/d^2), radius
// r sqrt(1 - r^2/d^2), perpendicular to c. Throws InputError unless 0 < radius < |center|.
Ellipse disk_of_sphere(const Eigen::Vector3d& center, double radius);

// The integral of z/pi d omega over the part of the ellipse where z >= 0 and n.p >= 0 for all the
// normals n, of any length, exact. In [0, 1]. Absolute error some 1e-14; where nothing is cut off,
// also relative. Throws InputError for what is not finite.
double clamped_cosine_share(const Ellipse& ellipse, std::span<const Eigen::Vector3d> normals = {});

// The share of a clamped cosine's transform by M (ltc/ltsd.h) on the ellipse, which is cut off at
// the surface's horizon before the transform and at that of the cosine after it. Throws InputError
// for a matrix without an inverse too.
double ltc_share(const Eigen::Matrix3d& matrix, const Ellipse& ellipse);

}  // namespace ltc
