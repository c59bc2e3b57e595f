// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Lobes as short lists of quantiles, cheap to compare: what checks of a whole table judge by.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aligned.h"
#include "fit/lobe_frame.h"
#include "fit/quantile_model.h"
#include "fit/sample_sets.h"
#include "ltc/folded.h"

namespace ltc {

// Along each of some directions, the sorted projections of a lobe's samples cut into blocks of
// equal mass, and the mean of each block. The mean absolute difference of two such lists is the
// sliced-Wasserstein distance of equation (9) of Aakash et al. 2022, but for what happens inside a
// block and in the tails: the first and the last block are left out, since the tails of GGX slopes,
// as 1/r^4, make nearly all of the noise. So the distance is at most the whole one.
//
// Directions, and what is projected on them, are those of the mirror's frame (lobe_frame.h), as
// offsets from the mirror direction: two lobes seen from different views are compared as if turned
// to the same one. The same samples serve every lobe, so that their noise cancels where lobes are
// alike.
class LobeQuantiles {
 public:
  // `samples` (rounded up to a multiple of 16) cosine and lattice samples; at least 3 blocks.
  LobeQuantiles(std::size_t samples, std::size_t directions, std::size_t blocks);

  std::size_t size() const { return directions_.size() * blocks_; }

  // Fills `quantiles`, size() floats, with those of the GGX lobe; and of an LTC, folded or not,
  // seen in that lobe's frame. Its M must be finite.
  void of_ggx(const LobeFrame& frame, float* quantiles);
  void of_ltc(const LobeFrame& frame, const LtcLobe& ltc, float* quantiles);

  // The distance of two lists; and the mean absolute deviation of a list, tails included, from the
  // median of each direction.
  double distance(const float* a, const float* b) const;
  double spread(const float* quantiles) const;

 private:
  std::size_t blocks_;
  CosineSet cosines_;
  TargetLattice lattice_;
  std::vector<Eigen::Vector3f> directions_;
  TargetSamples target_;
  AlignedFloats gx_, gy_, gz_, projections_;
  AlignedVector<std::uint64_t> keys_;
};

}  // namespace ltc
