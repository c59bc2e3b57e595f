// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "ltc/disk.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "ltc/ltsd.h"

namespace ltc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = std::numeric_limits<double>::epsilon();

bool are_perpendicular(const Vector3d& a, const Vector3d& b) {
  return std::abs(a.dot(b)) <= kRounding * a.norm() * b.norm();
}

// Turns the two half axes, which leaves the ellipse as it is.
void turn_perpendicular(Vector3d& a, Vector3d& b) {
  const double angle = std::atan2(2 * a.dot(b), a.squaredNorm() - b.squaredNorm()) / 2;
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const Vector3d turned = cosine * a + sine * b;
  b = cosine * b - sine * a;
  a = turned;
}

// The hyperbolic turn of a half axis and the centre, which leaves a a^T - c c^T and so the cone as
// it is: c + a and c - a, two rays on the cone, are made of equal length. Differences lose no
// digits where the other forms of the turn do.
void make_perpendicular_to_center(Vector3d& a, Vector3d& c) {
  Vector3d sum = c + a, difference = c - a;
  const double factor = std::sqrt(difference.norm() / sum.norm());
  sum *= factor;
  difference /= factor;
  c = (sum + difference) / 2;
  a = (sum - difference) / 2;
}

// The ellipse of the same cone whose half axes and centre are all perpendicular: the eigenvectors
// of the cone's quadratic form, by one-sided Jacobi turns, which keep small axes' digits beside
// large ones. Converges quadratically; the bound is never reached.
Ellipse principal(Ellipse e) {
  for (int sweep = 0; sweep < 60; ++sweep) {
    if (are_perpendicular(e.half_u, e.half_v) && are_perpendicular(e.half_u, e.center) &&
        are_perpendicular(e.half_v, e.center))
      break;
    turn_perpendicular(e.half_u, e.half_v);
    make_perpendicular_to_center(e.half_u, e.center);
    make_perpendicular_to_center(e.half_v, e.center);
  }
  return e;
}

// A piece of the boundary in the coordinates x, y of the ellipse: an arc of the unit circle, by its
// angles, or a chord.
struct Piece {
  bool is_arc;
  double from_angle, to_angle;
  Vector2d from, to;
};

Vector2d on_circle(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

Piece arc(double from, double to) {
  return {true, from, to, on_circle(from), on_circle(to)};
}

Piece chord(const Vector2d& from, const Vector2d& to) {
  return {false, 0, 0, from, to};
}

// height + slope.(x, y) >= 0: what a half-space through the origin is on the plane of the ellipse.
struct HalfPlane {
  double height;
  Vector2d slope;
  double at(const Vector2d& point) const { return height + slope.dot(point); }
};

// The angles strictly within the arc where it meets the half-plane's edge, in order.
std::vector<double> crossings(const Piece& piece, const HalfPlane& half) {
  const double length = half.slope.norm();
  std::vector<double> found;
  if (!(std::abs(half.height) < length))
    return found;
  const double middle = std::atan2(half.slope.y(), half.slope.x());
  const double reach = std::acos(-half.height / length);
  for (const double angle : {middle - reach, middle + reach}) {
    const double turns = std::ceil((piece.from_angle - angle) / (2 * kPi));
    const double within = angle + 2 * kPi * turns;
    if (within > piece.from_angle && within < piece.to_angle)
      found.push_back(within);
  }
  std::sort(found.begin(), found.end());
  return found;
}

void keep_part_of_arc(const Piece& piece, const HalfPlane& half, std::vector<Piece>& kept) {
  std::vector<double> ends = crossings(piece, half);
  ends.push_back(piece.to_angle);
  double from = piece.from_angle;
  for (const double to : ends) {
    if (half.at(on_circle((from + to) / 2)) > 0)
      kept.push_back(arc(from, to));
    from = to;
  }
}

void keep_part_of_chord(const Piece& piece, const HalfPlane& half, std::vector<Piece>& kept) {
  const double from = half.at(piece.from), to = half.at(piece.to);
  if (from <= 0 && to <= 0)
    return;
  const auto crossing = [&] {
    return ((std::abs(to) * piece.from + std::abs(from) * piece.to) /
            (std::abs(from) + std::abs(to)))
        .eval();
  };
  kept.push_back(chord(from < 0 ? crossing() : piece.from, to < 0 ? crossing() : piece.to));
}

// What is left is convex, so that one chord closes it.
std::vector<Piece> clipped(const std::vector<Piece>& boundary, const HalfPlane& half) {
  std::vector<Piece> kept, closed;
  for (const Piece& piece : boundary)
    piece.is_arc ? keep_part_of_arc(piece, half, kept) : keep_part_of_chord(piece, half, kept);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    closed.push_back(kept[i]);
    const Vector2d& next = kept[(i + 1) % kept.size()].from;
    if (kept[i].to != next)
      closed.push_back(chord(kept[i].to, next));
  }
  return closed;
}

// The integral of du/(constant + factor u^2), whose denominator is positive.
double integral_over(double from, double to, double constant, double factor) {
  const double ratio = std::sqrt(std::abs(factor) / constant);
  // Both inverse functions at once, of the difference: near ends and near circles keep their
  // digits.
  const double product = from * to * ratio * ratio, step = (to - from) * ratio;
  if (ratio == 0)
    return (to - from) / constant;
  const double angle =
      factor > 0 ? std::atan2(step, 1 + product) : std::atanh(step / (1 - product));
  return angle / (ratio * constant);
}

// Integral of (p x dp)_z/|p|^2 along an arc of a principal ellipse. |p|^2 = C + U cos^2 + V sin^2
// has no mixed terms, so that each of the three terms of p x dp has an elementary integral.
double arc_integral(const Ellipse& e, const Piece& piece) {
  const double c2 = e.center.squaredNorm(), u2 = e.half_u.squaredNorm(),
               v2 = e.half_v.squaredNorm();
  const double at_u = c2 + u2, at_v = c2 + v2;  // |p|^2 at the ends of the half axes
  // Of sin t dt = -d cos t and cos t dt = d sin t.
  const double of_sine = -integral_over(piece.from.x(), piece.to.x(), at_v, u2 - v2);
  const double of_cosine = integral_over(piece.from.y(), piece.to.y(), at_u, v2 - u2);
  // The polar angle of (x sqrt(at_u), y sqrt(at_v)), over as many turns as t has: it differs from t
  // by less than a quarter turn.
  const auto stretched = [&](double angle, const Vector2d& point) {
    return angle + std::atan2(point.x() * point.y() * (std::sqrt(at_v) - std::sqrt(at_u)),
                              std::sqrt(at_u) * point.x() * point.x() +
                                  std::sqrt(at_v) * point.y() * point.y());
  };
  const double of_one =
      (stretched(piece.to_angle, piece.to) - stretched(piece.from_angle, piece.from)) /
      std::sqrt(at_u * at_v);
  return e.half_u.cross(e.half_v).z() * of_one + e.center.cross(e.half_v).z() * of_cosine -
         e.center.cross(e.half_u).z() * of_sine;
}

// The same along a chord: Lambert's term of a polygon's edge.
double chord_integral(const Ellipse& e, const Piece& piece) {
  const auto direction = [&](const Vector2d& point) {
    return (e.center + point.x() * e.half_u + point.y() * e.half_v).normalized();
  };
  const Vector3d from = direction(piece.from), to = direction(piece.to);
  const Vector3d normal = from.cross(to - from);
  const double sine = normal.norm();
  return sine > 0 ? std::atan2(sine, from.dot(to)) * normal.z() / sine : 0;
}

// Of what lies above the horizon as a whole: the vector irradiance of an elliptic cone points along
// its axis.
double whole_share(const Ellipse& e) {
  const double c = e.center.norm(), u = e.half_u.norm(), v = e.half_v.norm();
  return u / std::hypot(c, u) * (v / std::hypot(c, v)) * (e.center.z() / c);
}

void require_finite(const Ellipse& e) {
  for (const Vector3d* const vector : {&e.center, &e.half_u, &e.half_v})
    if (!vector->allFinite())
      throw InputError(fmt::format("ellipse with the vector ({}, {}, {}): it must be finite",
                                   vector->x(), vector->y(), vector->z()));
}

bool has_no_extent(const Ellipse& e) {
  const double volume = e.half_u.cross(e.half_v).dot(e.center);
  return !(std::abs(volume) > kRounding * e.half_u.norm() * e.half_v.norm() * e.center.norm());
}

}  // namespace

Ellipse disk_of_sphere(const Vector3d& center, double radius) {
  const double distance = center.norm();
  if (!(radius > 0 && radius < distance && std::isfinite(distance)))
    throw InputError(fmt::format(
        "sphere of radius {} at distance {}: the radius must be positive and below the distance",
        radius, distance));
  const double ratio = radius / distance, left = (1 - ratio) * (1 + ratio);
  const Vector3d side = center.unitOrthogonal(), other = center.cross(side) / distance;
  const double disk_radius = radius * std::sqrt(left);
  return {left * center, disk_radius * side, disk_radius * other};
}

double clamped_cosine_share(const Ellipse& ellipse, std::span<const Vector3d> normals) {
  require_finite(ellipse);
  if (has_no_extent(ellipse))
    return 0;
  const Ellipse e = principal(ellipse);
  // Thirds, so that no arc is longer than half a turn.
  std::vector<Piece> boundary;
  for (int third = 0; third < 3; ++third)
    boundary.push_back(arc(2 * kPi / 3 * third, 2 * kPi / 3 * (third + 1)));
  boundary.front().from = boundary.back().to = {1, 0};
  bool cut = false;
  const auto clip = [&](const Vector3d& normal) {
    const HalfPlane half{normal.dot(e.center), {normal.dot(e.half_u), normal.dot(e.half_v)}};
    if (half.height >= half.slope.norm())
      return;
    cut = true;
    boundary = clipped(boundary, half);
  };
  clip(Vector3d::UnitZ());
  for (const Vector3d& normal : normals)
    clip(normal);
  if (!cut)
    return whole_share(e);
  double sum = 0;
  for (const Piece& piece : boundary)
    sum += piece.is_arc ? arc_integral(e, piece) : chord_integral(e, piece);
  return std::clamp(std::abs(sum) / (2 * kPi), 0.0, 1.0);
}

double ltc_share(const Eigen::Matrix3d& matrix, const Ellipse& ellipse) {
  if (!is_invertible(matrix))
    throw InputError(fmt::format("matrix of determinant {}: it must be finite and have an inverse",
                                 matrix.determinant()));
  const Eigen::Matrix3d inverse = matrix.inverse();
  // p_z = (M p')_z: the surface's horizon is a plane after the transform too.
  const Vector3d surface = matrix.row(2).transpose();
  return clamped_cosine_share(
      {inverse * ellipse.center, inverse * ellipse.half_u, inverse * ellipse.half_v},
      std::span(&surface, 1));
}

}  // namespace ltc
