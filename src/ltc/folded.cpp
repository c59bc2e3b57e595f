// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "ltc/folded.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "ltc/ltsd.h"
#include "ltc/polygon.h"

namespace ltc {
namespace {

using Eigen::Vector3d;

// A piece of the map, on either side of x = 0: u = behind |x| - sum z.
struct Piece {
  double behind = 0;  // how many creases
  double sum = 0;     // of their h
};

// The slope z/|x| of crease `next` on the folded side, where `piece` ends: that of its points is
// folded with the piece.
double folded_slope(const Piece& piece, double h, const Fold& fold) {
  return h > 0 ? (1 - fold.g * piece.sum) / h + fold.g * piece.behind
               : std::numeric_limits<double>::infinity();
}

// Where a point of the folded side lies.
Piece piece_at(const Vector3d& p, const Fold& fold, const Creases& creases) {
  Piece piece;
  for (const double h : creases) {
    const double slope = folded_slope(piece, h, fold);
    // On x = 0 all creases are behind below, none above.
    if (p.x() == 0 ? p.z() >= 0 : p.z() >= slope * std::abs(p.x()))
      break;
    ++piece.behind;
    piece.sum += h;
  }
  return piece;
}

Vector3d unfolded_in(const Piece& piece, const Vector3d& p, const Fold& fold) {
  const double x = std::abs(p.x());
  const double u = (piece.behind * x - piece.sum * p.z()) / (1 - fold.g * piece.sum);
  return {p.x(), p.y() - fold.k * u, p.z() - fold.g * u};
}

// The places on (0, 1) where an edge meets a plane a.p = 0, by the values at its ends.
void add_crossing(double from, double to, std::vector<double>& places) {
  if ((from > 0 && to < 0) || (from < 0 && to > 0))
    places.push_back(from / (from - to));
}

// The part of a polygon on one side of x = 0.
std::vector<Vector3d> half_of(const std::vector<Vector3d>& vertices, double side) {
  std::vector<Vector3d> kept;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vector3d& a = vertices[i];
    const Vector3d& b = vertices[(i + 1) % vertices.size()];
    if (side * a.x() >= 0)
      kept.push_back(a);
    if ((a.x() > 0 && b.x() < 0) || (a.x() < 0 && b.x() > 0)) {
      Vector3d crossing = std::abs(b.x()) * a + std::abs(a.x()) * b;
      crossing.x() = 0;
      kept.push_back(crossing);
    }
  }
  return kept;
}

// The slopes of the creases on the folded side; of one at x = 0 there is none.
std::vector<double> folded_slopes(const Fold& fold, const Creases& creases) {
  std::vector<double> slopes;
  Piece piece;
  for (const double h : creases) {
    if (h > 0)
      slopes.push_back(folded_slope(piece, h, fold));
    ++piece.behind;
    piece.sum += h;
  }
  return slopes;
}

// A half of a polygon on the folded side with vertices wherever the map has a kink: on the creases
// and, along x = 0, at the horizon.
std::vector<Vector3d> with_creases(const std::vector<Vector3d>& half,
                                   const std::vector<double>& slopes) {
  std::vector<Vector3d> result;
  std::vector<double> places;
  for (std::size_t i = 0; i < half.size(); ++i) {
    const Vector3d& a = half[i];
    const Vector3d& b = half[(i + 1) % half.size()];
    result.push_back(a);
    places.clear();
    for (const double slope : slopes)
      add_crossing(a.z() - slope * std::abs(a.x()), b.z() - slope * std::abs(b.x()), places);
    if (a.x() == 0 && b.x() == 0)
      add_crossing(a.z(), b.z(), places);
    std::ranges::sort(places);
    for (const double place : places)
      result.push_back(a + place * (b - a));
  }
  return result;
}

void require_creases(const Creases& creases) {
  for (std::size_t i = 0; i < creases.size(); ++i)
    if (!std::isfinite(creases[i]) || creases[i] < 0 || (i > 0 && creases[i] <= creases[i - 1]))
      throw InputError(fmt::format(
          "crease {} at h = {}: expected finite numbers from 0 on that increase", i, creases[i]));
}

}  // namespace

double sum_of(const Creases& creases) {
  return std::accumulate(creases.begin(), creases.end(), 0.0);
}

bool is_one_to_one(const Fold& fold, const Creases& creases) {
  return std::isfinite(fold.k) && std::isfinite(fold.g) && fold.g * sum_of(creases) < 1;
}

double crease_distance(const Vector3d& p, const Creases& creases) {
  double u = 0;
  for (const double h : creases)
    u += std::max(0.0, std::abs(p.x()) - h * p.z());
  return u;
}

Vector3d folded(const Vector3d& p, const Fold& fold, const Creases& creases) {
  const double u = crease_distance(p, creases);
  return {p.x(), p.y() + fold.k * u, p.z() + fold.g * u};
}

Vector3d unfolded(const Vector3d& p, const Fold& fold, const Creases& creases) {
  return unfolded_in(piece_at(p, fold, creases), p, fold);
}

FoldedCosine::FoldedCosine(const Eigen::Matrix3d& matrix, const Fold& fold, const Creases& creases)
    : matrix_(matrix),
      inverse_(matrix.inverse()),
      inverse_determinant_(inverse_.determinant()),
      fold_(fold),
      creases_(creases) {
  if (!is_invertible(matrix))
    throw InputError(fmt::format(
        "matrix of a folded lobe has determinant {}: it must be finite and have an inverse",
        matrix.determinant()));
  require_creases(creases);
  if (!is_one_to_one(fold, creases))
    throw InputError(fmt::format(
        "fold with k = {}, g = {}: expected finite numbers, g times the sum of the creases below 1",
        fold.k, fold.g));
}

double FoldedCosine::density(const Vector3d& omega) const {
  const Vector3d p = inverse_ * omega;
  const Piece piece = piece_at(p, fold_, creases_);
  const Vector3d o = unfolded_in(piece, p, fold_);
  const double length = o.norm();
  return original_density(Original::clamped_cosine, o / length) * std::abs(inverse_determinant_) /
         ((1 - fold_.g * piece.sum) * length * length * length);
}

Vector3d FoldedCosine::sample(double u_height, double u_azimuth) const {
  const Vector3d o = sample_original(Original::clamped_cosine, u_height, u_azimuth);
  return (matrix_ * folded(o, fold_, creases_)).normalized();
}

double FoldedCosine::integrate_polygon(std::span<const Vector3d> vertices) const {
  std::vector<Vector3d> transformed;
  transformed.reserve(vertices.size());
  for (const Vector3d& vertex : vertices)
    transformed.push_back(inverse_ * vertex);
  double integral = 0;
  if (fold_ == Fold{}) {
    integral = polygon_cosine_integral(clip_to_upper_hemisphere(transformed));
  } else {
    // Half by half: the horizon's arc that closes what is cut may be longer than half a turn, which
    // no two ends tell; in a half it never is.
    const std::vector<double> slopes = folded_slopes(fold_, creases_);
    for (const double side : {1.0, -1.0}) {
      std::vector<Vector3d> half = with_creases(half_of(transformed, side), slopes);
      for (Vector3d& p : half)
        p = unfolded(p, fold_, creases_);
      integral += polygon_cosine_integral(clip_to_upper_hemisphere(half));
    }
  }
  return (inverse_determinant_ < 0 ? -integral : integral) / std::numbers::pi;
}

double share_below_horizon(const LtcLobe& lobe) {
  if (lobe.creases.empty())
    return share_below_horizon(lobe.matrix);
  const FoldedCosine cosine(lobe);
  double sum = 0;
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      sum += std::abs(
          cosine.integrate_polygon(std::array<Vector3d, 3>{{{x, 0, 0}, {0, y, 0}, {0, 0, -1}}}));
  return sum;
}

}  // namespace ltc
