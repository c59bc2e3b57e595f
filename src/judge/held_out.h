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
#include "judge/quantile_cells.h"
#include "ltc/folded.h"
#include "ltc/horizon.h"

namespace hwy {
class Sorter;
}

namespace ltc {

// What two matrices are to a lobe, and to each other: sliced-Wasserstein distances; NaN where a
// matrix that they need is not finite.
struct PairJudgement {
  double loss_a = 0, loss_b = 0;  // to the GGX lobe
  double distance = 0;            // between the two LTC
  double spread = 0;              // of the GGX lobe, see HeldOutJudge::spread
};

// Sorts, never bins: the distance between the two sample sets is exact.
class HeldOutJudge {
 public:
  static constexpr std::size_t usual_samples = 16384, usual_directions = 64;
  static constexpr std::uint64_t usual_seed = 20220712;

  // `samples` weighted lattice samples of the lobe and as many cosine samples, along `directions`
  // of sample_sets.h's turned ones; the seed shifts the lattices and turns the directions, so that
  // they differ from those of any fit. LTCs whose horizon is scaled are judged by their samples
  // above it alone (by all where none is).
  explicit HeldOutJudge(std::size_t samples = usual_samples,
                        std::size_t directions = usual_directions, std::uint64_t seed = usual_seed,
                        HorizonMode horizon = HorizonMode::clipped);

  // Sets the lobe that loss and spread judge against; before either.
  void set_lobe(const Lobe& lobe);

  // Equation (9) of Aakash et al. 2022 between the lobe and an LTC, folded or not; NaN for a matrix
  // that is not finite.
  double loss(const LtcLobe& ltc);

  // Mean absolute deviation of the lobe's projections from their median, averaged over the
  // directions: the distance to the best single direction. Losses are judged relative to it.
  double spread() const { return spread_; }

  // The same figures for two of them at once, and the distance between their LTC. Independent of
  // set_lobe, and keeps nothing: sets are sorted one direction at a time and stay in the cache.
  PairJudgement judge_pair(const Lobe& lobe, const LtcLobe& a, const LtcLobe& b);

 private:
  struct Points {  // as offsets from the mirror direction, in its frame
    AlignedFloats x, y, z;
    std::size_t count = 0;  // of them; behind are left-overs
  };
  void sample_target(const LobeFrame& frame);
  // The lobe's samples along one direction.
  void sort_target(const Eigen::Vector3f& direction, const hwy::Sorter& sorter,
                   QuantileCells& cells);
  void transform(const LobeFrame& frame, const LtcLobe& ltc, HorizonMode horizon,
                 Points& points) const;
  // Points along a direction, in ascending order.
  static void sort_points(const Eigen::Vector3f& direction, const Points& points,
                          const hwy::Sorter& sorter, AlignedFloats& sorted);

  HorizonMode horizon_;
  CosineSet cosines_;
  TargetLattice lattice_;
  std::vector<Eigen::Vector3d> directions_;
  std::optional<LobeFrame> frame_;
  std::vector<QuantileCells> cells_;  // of set_lobe's, one a direction
  double spread_ = 0;
  // Scratch of one call.
  TargetSamples target_;
  double target_total_ = 0;
  float target_largest_ = 0;
  AlignedVector<std::uint64_t> keys_;
  QuantileCells pair_cells_;
  Points points_, points_b_;
  AlignedFloats sorted_, sorted_b_;
};

}  // namespace ltc
