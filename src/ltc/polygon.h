// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Exact integrals of powers of the cosine over polygons seen from the origin.
//
// Vertices are points of any length in order; an edge covers the shorter arc between its ends. All
// integrals have a sign: positive where the vertices turn counter-clockwise seen from outside the
// sphere (from above, for a polygon overhead), negative otherwise. A degenerate polygon (fewer than
// three vertices, repeated ones, all in one plane with the origin) integrates to zero; an edge
// through the origin itself, whose arc is undefined, counts as nothing. Every function throws
// InputError on a vertex at the origin or one that is not finite.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace ltc {

// The part of a polygon at z >= 0. Vertices of unit length; those made by clipping lie at z = 0
// exactly. Edges along the horizon close it.
std::vector<Eigen::Vector3d> clip_to_upper_hemisphere(std::span<const Eigen::Vector3d> vertices);

// Integral of d omega: the solid angle, by van Oosterom and Strackee 1983 over a fan of triangles.
double polygon_solid_angle(std::span<const Eigen::Vector3d> vertices);

// Integral of z d omega, by Lambert's formula: equation (11) of Heitz et al. 2016 but for 1/pi. For
// the clamped cosine the polygon must be clipped first. Accurate to 1e-16 relative to the longest
// edge times the largest extent, so that tiny polygons keep their digits.
double polygon_cosine_integral(std::span<const Eigen::Vector3d> vertices);

// Integral of z^2 d omega, by the axial moments of Arvo 1995, "Applications of Irradiance Tensors
// to the Simulation of Non-Lambertian Phenomena". For the clamped cosine the polygon must be
// clipped first. Accurate to 1e-16 of the longest edge.
double polygon_squared_cosine_integral(std::span<const Eigen::Vector3d> vertices);

}  // namespace ltc
