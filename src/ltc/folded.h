// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Folded linearly transformed cosines: a clamped cosine folded along creases before the matrix, so
// that its lobe bends as those of GGX do, which no matrix alone can ("lunes": section 6 of Aakash
// et al. 2022).
//
// omega ~ M fold(omega_o), omega_o distributed as the clamped cosine,
//
//   fold(x, y, z) = (x, y + k u, z + g u),   u = sum over the creases h of max(0, |x| - h z).
//
// The map is continuous and linear on each piece between the creases |x| = h z, homogeneous, and
// mirror symmetric in x. Where the m narrowest creases are behind (|x| > h z for these alone), u =
// m |x| - H z with H the sum of their h, and the piece's determinant is 1 - g H: the map is one to
// one where all of these are positive, that is where g times the sum of all h is below 1. As a map
// of homogeneous degree one that is linear by pieces it takes polygons to polygons: the integral
// over a polygon is that of the plain cosine over the polygon unfolded, once it has vertices on the
// creases. k = g = 0 is the LTC.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace ltc {

struct Fold {
  double k = 0, g = 0;
  bool operator==(const Fold&) const = default;
};

// The h of each pair of creases, >= 0 and increasing; 0 is a crease along x = 0.
using Creases = std::vector<double>;

// What tables and fields have unless they say otherwise; and the one of two pairs.
inline const Creases usual_creases = {0.4};
inline const Creases two_pairs_of_creases = {0.3, 1.0};

// One pair, or two where `second` is not 0.
Creases creases_at(double first, double second);

// Of all h, the H of the last piece.
double sum_of(const Creases& creases);

// Whether the fold is one to one: 1 - g H > 0 on every piece, k and g finite.
bool is_one_to_one(const Fold& fold, const Creases& creases);

// u at a point, and the fold and its inverse, on all of space.
double crease_distance(const Eigen::Vector3d& p, const Creases& creases);
Eigen::Vector3d folded(const Eigen::Vector3d& p, const Fold& fold, const Creases& creases);
Eigen::Vector3d unfolded(const Eigen::Vector3d& p, const Fold& fold, const Creases& creases);

// What makes a lobe: M, known up to a factor, and of a folded one its fold and creases.
struct LtcLobe {
  Eigen::Matrix3d matrix;
  Fold fold = {};
  Creases creases = {};

  template <typename Derived>
  LtcLobe(const Eigen::MatrixBase<Derived>& m) : matrix(m) {}
  LtcLobe(const Eigen::Matrix3d& m, const Fold& f, const Creases& c)
      : matrix(m), fold(f), creases(c) {}
};

// The share of a lobe below the horizon z = 0, exact: as ltsd.h's of an LTC.
double share_below_horizon(const LtcLobe& lobe);

// The distribution of M fold(omega_o)/|M fold(omega_o)|. M is known up to a factor.
class FoldedCosine {
 public:
  // Throws InputError for a matrix that is not finite or has no inverse, creases that are not
  // finite, negative or not increasing, and a fold that is not one to one.
  FoldedCosine(const Eigen::Matrix3d& matrix, const Fold& fold,
               const Creases& creases = usual_creases);
  explicit FoldedCosine(const LtcLobe& lobe) : FoldedCosine(lobe.matrix, lobe.fold, lobe.creases) {}

  // Density per steradian at a unit direction: max(z, 0)/(pi |p|^4 |det M| (1 - g H)) with p the
  // direction taken back, fold^-1(M^-1 omega), and H of the piece where that is.
  double density(const Eigen::Vector3d& omega) const;

  // A unit direction from two uniforms on [0, 1).
  Eigen::Vector3d sample(double u_height, double u_azimuth) const;

  // As LinearlyTransformed::integrate_polygon (ltc/ltsd.h), to the bit where k = g = 0. One
  // integral: vertices are inserted where edges cross creases, all are unfolded and cut at z = 0.
  double integrate_polygon(std::span<const Eigen::Vector3d> vertices) const;

 private:
  Eigen::Matrix3d matrix_, inverse_;
  double inverse_determinant_;
  Fold fold_;
  Creases creases_;
};

}  // namespace ltc
