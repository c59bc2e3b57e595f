// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The sliced-Wasserstein loss and its gradient in double precision, by sorting: the reference that
// the fast versions of the fit are tested against.
//
// Along a unit direction d a set of directions f_i of weights w_i (total 1) has the projections
// x_i = d . f_i and a quantile function F^-1, a staircase over the sorted x_i with steps w_i wide.
// The distance of two sets is the mean over d of
//     int_0^1 |F^-1(u) - G^-1(u)| du,
// equation (9) of Aakash et al. 2022, "Bringing Linearly Transformed Cosines to Anisotropic GGX".
// Two staircases differ by a constant on every interval between their merged edges, so that the
// integral is a finite sum, exact for sets of any sizes and weights; sets of equal size and weights
// give equation (10).
//
// Gradient. Let f = M omega / l with l = |M omega|. With y = M omega,
//     dx/dy = (d - (d . f) f) / l,   dy/dM_rc = e_r omega_c,   so   dx/dM = (d - x f) omega^T / l.
// The term -x f is that of the normalisation: a change of M along f moves nothing. As long as no
// two projections change places and none meets its partner,
//     dL/dM = mean_d sum_i s_i dx_i/dM,   s_i = int over i's step of sign(F^-1(u) - G^-1(u)) du,
// where s_i = +-1/n in equation (10). Scaling M moves nothing, hence <M, dL/dM> = 0.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ltc {

// Directions, or any points; `weights` >= 0, or empty where all weigh the same.
struct PointSet {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
};

// Equation (9) with the mean over the given unit directions. Symmetric in the two sets. Throws
// InputError where a set or the directions are empty, weights are negative or add up to nothing, or
// a coordinate is not finite.
double sliced_wasserstein(const PointSet& f, const PointSet& g,
                          const std::vector<Eigen::Vector3d>& directions);

struct LossAndGradient {
  double loss = 0;
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();  // with respect to M
  // Names the smooth piece of the loss that M lies in: between matrices of one piece, the signs s_i
  // above stay the same but for kinks that come in pairs.
  std::uint64_t piece = 0;
};

// Equation (10) as a function of M, for fixed samples, target and directions.
class SlicedWassersteinLoss {
 public:
  // `omega_o` are equally weighted clamped-cosine directions. Throws InputError as above.
  SlicedWassersteinLoss(std::vector<Eigen::Vector3d> omega_o, const PointSet& target,
                        std::vector<Eigen::Vector3d> directions);

  // Loss and gradient at M. All NaN where some M omega_o vanishes or is not finite.
  LossAndGradient operator()(const Eigen::Matrix3d& matrix) const;

  // One point of a set along a direction.
  struct Atom {
    double projection, mass;
    std::size_t index;
  };

 private:
  std::vector<Eigen::Vector3d> omega_o_, directions_;
  std::vector<std::vector<Atom>> target_;  // sorted, one set a direction
};

}  // namespace ltc
