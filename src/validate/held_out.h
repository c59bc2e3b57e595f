// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The judge: the sliced-Wasserstein loss of a matrix on samples that no fit has seen.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "brdf/ggx.h"
#include "fit/lobe_frame.h"
#include "fit/quantile_model.h"
#include "fit/sample_sets.h"

namespace ltc {

// Sorts, never bins: the distance between the two sample sets is exact.
class HeldOutJudge {
 public:
  // `samples` weighted lattice samples of the lobe and as many cosine samples, `directions` random
  // ones; lattices are shifted by the seed, so that they differ from those of any fit.
  explicit HeldOutJudge(std::size_t samples = 16384, std::size_t directions = 64,
                        std::uint64_t seed = 20220712);

  // Sets the lobe to judge against; before anything below.
  void set_lobe(const GgxLobe& lobe);

  // Equation (9) of Aakash et al. 2022 between the lobe and the LTC of M; NaN for a matrix that is
  // not finite.
  double loss(const Eigen::Matrix3d& matrix);

  // Mean absolute deviation of the lobe's projections from their median, averaged over the
  // directions: the distance to the best single direction. Losses are judged relative to it.
  double spread() const { return spread_; }

 private:
  CosineSet cosines_;
  TargetLattice lattice_;
  std::vector<Eigen::Vector3d> directions_;
  std::optional<LobeFrame> frame_;
  TargetSamples target_;
  AlignedFloats sorted_values_, cumulative_;  // direction-major
  AlignedVector<std::uint64_t> keys_;
  AlignedFloats gx_, gy_, gz_, projections_;
  double spread_ = 0;
};

}  // namespace ltc
