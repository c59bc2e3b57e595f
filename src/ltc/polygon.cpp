// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Exact integrals over polygons seen from the origin.
#include "ltc/polygon.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.h"

namespace ltc {
namespace {

using Vertices = std::span<const Eigen::Vector3d>;

std::vector<Eigen::Vector3d> directions_of(Vertices vertices) {
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(vertices.size());
  for (const Eigen::Vector3d& vertex : vertices) {
    const double length = vertex.stableNorm();
    if (!(length > 0) || !std::isfinite(length))
      throw InputError(
          fmt::format("polygon vertex ({}, {}, {}): it must be finite and away from the origin",
                      vertex.x(), vertex.y(), vertex.z()));
    directions.push_back(vertex / length);
  }
  return directions;
}

// theta/sin(theta) - 1 of an edge with the given sine >= 0 and cosine. Zero where the ends are
// opposite: the arc between them is undefined.
double excess_of_angle_over_sine(double sine, double cosine) {
  if (cosine > 0 && sine < 0.01) {
    // Series of asin(s)/s - 1; what is left out, 35 s^8/1152, is below 4e-18.
    const double s2 = sine * sine;
    return s2 * (1.0 / 6 + s2 * (3.0 / 40 + s2 * (5.0 / 112)));
  }
  return sine > 0 ? std::atan2(sine, cosine) / sine - 1 : -1;
}

}  // namespace

std::vector<Eigen::Vector3d> clip_to_upper_hemisphere(Vertices vertices) {
  const std::vector<Eigen::Vector3d> directions = directions_of(vertices);
  std::vector<Eigen::Vector3d> clipped;
  clipped.reserve(directions.size() + 2);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Eigen::Vector3d& from = directions[i];
    const Eigen::Vector3d& to = directions[(i + 1) % directions.size()];
    if (from.z() >= 0)
      clipped.push_back(from);
    if ((from.z() > 0 && to.z() < 0) || (from.z() < 0 && to.z() > 0)) {
      // Where the chord meets z = 0. Opposite ends leave no direction: nothing is added.
      Eigen::Vector3d crossing = std::abs(to.z()) * from + std::abs(from.z()) * to;
      crossing.z() = 0;
      const double length = crossing.norm();
      if (length > 0)
        clipped.push_back(crossing / length);
    }
  }
  return clipped;
}

double polygon_solid_angle(Vertices vertices) {
  const std::vector<Eigen::Vector3d> p = directions_of(vertices);
  double sum = 0;
  for (std::size_t i = 2; i < p.size(); ++i) {
    // The triple product from differences, for the digits of small triangles.
    const double triple = p[0].dot((p[i - 1] - p[0]).cross(p[i] - p[0]));
    const double denominator = 1 + p[0].dot(p[i - 1]) + p[i - 1].dot(p[i]) + p[i].dot(p[0]);
    sum += 2 * std::atan2(triple, denominator);
  }
  return sum;
}

// Lambert: 1/2 sum over edges of theta (a x b)_z/|a x b| = 1/2 sum (a x b)_z (1 + (theta/sin - 1)).
// The sum of (a x b)_z alone is a polygon's area vector, which does not change when all vertices
// are taken relative to the first: so computed, the terms are as small as the polygon, and what
// they leave is of third order in the edges.
double polygon_cosine_integral(Vertices vertices) {
  const std::vector<Eigen::Vector3d> p = directions_of(vertices);
  double area = 0, excess = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector3d& a = p[i];
    const Eigen::Vector3d& b = p[(i + 1) % p.size()];
    area += (a - p[0]).cross(b - p[0]).z();
    const Eigen::Vector3d normal = a.cross(b - a);  // a x b of ends that are near each other
    excess += excess_of_angle_over_sine(normal.norm(), a.dot(b)) * normal.z();
  }
  return (area + excess) / 2;
}

// 3 int z^2 = int 1 + sum over edges of n_z int z ds, with n = (a x b)/|a x b| the edge's normal
// inwards. Along the arc int z ds = sin(theta) (a_z + b_z)/(1 + cos(theta)), and the sine cancels
// against |a x b|: what is left is (a x b)_z q, q = (a_z + b_z)/(1 + a.b). All q of a small polygon
// are near the first vertex's z, which is therefore taken out: the sum of (a x b)_z alone is the
// area of polygon_cosine_integral, and what q differs by is as small as the polygon.
double polygon_squared_cosine_integral(Vertices vertices) {
  const std::vector<Eigen::Vector3d> p = directions_of(vertices);
  double sum = polygon_solid_angle(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector3d& a = p[i];
    const Eigen::Vector3d& b = p[(i + 1) % p.size()];
    const double one_plus_cosine = 1 + a.dot(b), z = p[0].z();
    sum += z * (a - p[0]).cross(b - p[0]).z();
    // An edge between opposite ends counts as nothing.
    const double q_less_z =
        one_plus_cosine > 0
            ? ((a.z() - z) + (b.z() - z) + z * (a - b).squaredNorm() / 2) / one_plus_cosine
            : -z;
    sum += a.cross(b - a).z() * q_less_z;
  }
  return sum / 3;
}

}  // namespace ltc
