// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The distribution of an LTC along a direction in closed form or by a few nodes along an arc, and
// its derivative: no samples of the LTC, no bins. In double precision, for whatever vector unit the
// CPU has, many pairs (d, t) of a direction and a threshold at once.
//
// For directions omega = W omega_o/|W omega_o| of clamped-cosine omega_o, F(d, t) = P(d . omega >
// t) is the clamped cosine's measure of a cone. It is taken for t > 0; otherwise it is 1 - F(-d,
// -t). Then with
//     C = W^T N W,   N = d d^T - t^2 I
// the cone is the half of {a : a^T C a > 0} with d . W a > 0, convex and elliptic, and F is the
// area of its projection on the unit disk over pi (Nusselt). What changes when W does is
//     dF/dW = 2 N W dF/dC,
// dF/dC a symmetric matrix. C_h, the part of C on the horizon's plane z = 0, has at most one
// positive eigenvalue. Where it has
// - none, the horizon does not cut the cone: it is empty (t >= 1), below, or whole. Whole, F is
// that
//   of an ellipse seen along its axis, times the axis' height: with lambda the positive eigenvalue
//   of C, the largest root of its characteristic polynomial, E = adj(C - lambda I) and S = tr E,
//       F = lambda sqrt(E_zz)/S.
// - one, with eigenvector q towards d, the cone's edge meets the horizon at two directions that q
//   halves. Half a great circle from q to -q through e(psi) = sin psi u + cos psi z, u = (-q_y,
//   q_x), psi in (-pi/2, pi/2), has its points at a = x q + e(psi), x from infinity to minus
//   infinity, and leaves the cone once, at the larger root of
//       x^2 C_qq + 2 x cos psi C_qz + e^T C e = 0.
//   With S = 1/(1 + x^2), r the root of the discriminant,
//       F = 1/(2 pi) int cos psi (arccot x - x S) dpsi,
//       dF/dC = 1/(2 pi) int cos psi S^2/r a a^T dpsi,
//   by Gauss nodes in psi: the integrand is analytic, but the thinner the lobe, the nearer are its
//   singularities.
// t near 0 loses digits: dF/dC is of the order 1/t there, N W in proportion to t only along the
// cone's edge. `least_arc_threshold` is what is left of single precision.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aligned.h"
#include "core/points.h"

namespace ltc::kernels {

// What every array of pairs is padded to, and the least |t| that a pair may have.
inline constexpr std::size_t arc_lanes = 8;
inline constexpr double least_arc_threshold = 1e-6;

constexpr std::size_t padded_to_lanes(std::size_t count) {
  return (count + arc_lanes - 1) / arc_lanes * arc_lanes;
}

// Gauss-Legendre nodes in psi: sin psi, cos psi, and the node's weight times cos psi / (2 pi).
struct ArcNodes {
  explicit ArcNodes(std::size_t count);
  AlignedVector<double> sine, cosine, weight;
};

// `count` pairs, a multiple of arc_lanes; |t| >= least_arc_threshold.
struct ArcPairs {
  const double* dx;
  const double* dy;
  const double* dz;
  const double* t;
  std::size_t count;
};

// Of the pairs: F, and of those whose F depends on W the derivative. Buffers, reused from one
// evaluation to the next.
class ArcDistributions {
 public:
  // W row-major, not singular. Without `derivatives` F alone.
  void evaluate(const double* w, const ArcPairs& pairs, const ArcNodes& nodes, bool derivatives);

  AlignedVector<double> f;  // of every pair
  // Entry (row, column) of the derivative of pair moving[i] is
  // jacobian[(3 row + column) jacobian_stride + i], but of F(-d, -t) where t < 0: the derivative of
  // F has the other sign there. Padded with pairs -1.
  std::vector<std::int32_t> moving;
  AlignedVector<double> jacobian;
  std::size_t jacobian_stride = 0;

 private:
  AlignedVector<double> cut_, whole_, cone_f_;
};

// What the derivatives J_i of the moving pairs add up to: the gradient sum of first_i J_i, and the
// curvature sum of second_i J_i J_i^T, row-major 9 x 9.
void arc_sums(const ArcDistributions& distributions, const double* first, const double* second,
              double* gradient, double* curvature);

// A lobe's samples: along (dx, dy, dz), from the offsets' weighted mean on, thresholds
// centre + scale z_j with scale the mean absolute deviation; `above` becomes the share of the
// weight that lies above each, on average over thresholds within scale ramp_j/2 of it.
struct ArcCounts {
  double centre, scale;
};
ArcCounts count_above(const float* direction, const Points& g, const float* weight, const double* z,
                      const double* ramp, std::size_t thresholds, float* xi, double* above);

}  // namespace ltc::kernels
