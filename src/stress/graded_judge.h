// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The judge of stress runs: the sliced-Wasserstein loss in double precision, with samples so graded
// that sharp lobes can be told apart.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "brdf/lobe_model.h"
#include "core/aligned.h"
#include "fit/lobe_frame.h"
#include "ltc/folded.h"

namespace hwy {
class Sorter;
}

namespace ltc {

// Slopes of a sharp lobe have the tail (1 - u)^(-1/2) over the heights u of cosine samples and of
// visible normals alike. With equally weighted samples the outermost ones make a noise of n^(-1/2):
// at n = 8192 a perfect fit looks 3 % of the lobe's spread off, and fits that happen to match the
// noise look better than it. With 1 - u = t^2, t evenly spaced and weights 2 t, the integrand is
// smooth and the noise falls as 1/n.
//
// Of the fit it shares the lattice alone, turned to places of its own: sampling, transformation and
// projection are in double, and quantiles are compared exactly by sorting (keys are rounded to
// float).
class GradedJudge {
 public:
  GradedJudge(std::size_t samples, std::size_t directions, std::uint64_t seed);

  // Sets the lobe that the others judge against; before either.
  void set_lobe(const Lobe& lobe);

  // Equation (9) of Aakash et al. 2022 between the lobe and the LTC of M, folded or not
  // (ltc/folded.h); NaN for a matrix or a fold that is not finite, or that sends a sample nowhere.
  double loss(const Eigen::Matrix3d& matrix, const Fold& fold = {}, const Creases& creases = {});

  // What `loss` says of the lobe itself, sampled anew: losses below it cannot be told apart.
  double noise() const { return noise_; }

  // Mean absolute deviation of the lobe's projections from their median, averaged over the
  // directions.
  double spread() const { return spread_; }

 private:
  struct Points {  // offsets from the mirror direction, in its frame, as columns
    Eigen::Matrix3Xd offset;
    std::vector<double> mass;
  };
  // Sorted along one direction.
  struct Staircase {
    std::vector<double> value, mass;
  };
  void sample_lobe(const LobeSampler& sampler, const GradedLattice& lattice, Points& points) const;
  void sort(const Points& points, const Eigen::Vector3d& direction, const hwy::Sorter& sorter,
            Staircase& staircase);
  // Mean over the directions of the distance to the lobe.
  double distance_to_lobe(const Points& points);

  GradedLattice of_lobe_, of_lobe_again_, of_cosine_;
  std::vector<Eigen::Vector3d> directions_;
  std::optional<LobeFrame> frame_;
  std::vector<Staircase> lobe_;  // one a direction
  double spread_ = 0, noise_ = 0;
  // Scratch of one call.
  Points points_;
  Staircase staircase_;
  AlignedVector<std::uint64_t> keys_;
};

}  // namespace ltc
