// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The local model that a Gauss-Newton step minimises: loss, gradient and curvature of the
// sliced-Wasserstein distance as a function of the frame matrix P.
//
// For a projection direction d let F be the distribution function of d . omega over the LTC and G
// the one over the lobe. The loss is mean_d of int_0^1 |F^-1(u) - G^-1(u)| du (equation 9 of
// Aakash et al. 2022). What moves when P moves is the quantile function, and its derivative is a
// conditional mean,
//     dF^-1(u)/dP = E[dx/dP | x = F^-1(u)],   dx/dP = (1/|P a'|) (d - x f) a'^T,  a' = A omega_o.
// Samples are cut into blocks of neighbouring quantiles (here the bins of kernels.h); with J the
// block's mean dx/dP (nine numbers), r its mean difference from the target's quantiles and p its
// share of the samples, iteratively reweighted least squares for the L1 loss has
//     gradient = sum p r/(|r| + e) J,     curvature = sum p/(|r| + e) J J^T.
// Where the horizon is scaled (ltc/horizon.h), all of this is of the samples above it: the loss
// exactly so, the gradient but for what moves across the horizon.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "brdf/lobe_model.h"
#include "core/aligned.h"
#include "fit/kernels.h"
#include "fit/lobe_frame.h"
#include "fit/sample_sets.h"
#include "fit/settings.h"

namespace ltc {

using kernels::BinSpacing;

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

// A matrix as nine numbers, row-major, and back.
inline Vector9 flattened(const Eigen::Matrix3d& matrix) {
  Vector9 flat;
  for (int i = 0; i < 9; ++i)
    flat[i] = matrix(i / 3, i % 3);
  return flat;
}
inline Eigen::Matrix3d unflattened(const Vector9& flat) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 9; ++i)
    matrix(i / 3, i % 3) = flat[i];
  return matrix;
}

// Weighted mean and covariance of every eighth sample: enough to place bins and starts.
struct TargetMoments {
  Eigen::Vector3d mean;
  Eigen::Matrix3d covariance;
};
TargetMoments target_moments(const TargetSamples& samples);

// Mean absolute deviation of the samples' projections on a direction from `centre`, by the same
// subset. The tails of GGX slopes have no variance, but they have this; for their Student
// distribution it is the scale of kernels.h.
double target_deviation(const TargetSamples& samples, const Eigen::Vector3d& direction,
                        double centre);

// Weighted samples on a lattice (for GGX reflections about visible normals, weights G2/G1): so that
// the lattice's noise is the only one.
void sample_weighted_target(const LobeFrame& frame, const TargetLattice& lattice,
                            TargetSamples& samples);

// The same on a graded lattice, each sample weighted by its mass too; in double precision, for the
// lattice reaches far into the tails.
void sample_graded_target(const LobeFrame& frame, const GradedLattice& lattice,
                          TargetSamples& samples);

// `count` samples of algorithm 1 (by rejection), all of weight 1, padded with weight 0.
void sample_rejection_target(const LobeFrame& frame, std::size_t count, std::uint64_t seed,
                             TargetSamples& samples);

// What of a target its quantiles are made from, small enough to keep for every lobe of a table: for
// each direction the bins' place and each bin's weight and weighted sum of projections.
struct BinnedTarget {
  std::vector<float> values;  // direction-major: centre, 1 / scale, pairs (w, w xi)
  double spread = 0;
  bool heavy_tails = true;
};

// The target seen along a set of directions: for each, mass and first moment of the lobe below
// every bin edge.
class TargetQuantiles {
 public:
  // Bins `samples` along every direction, the bins spaced as the samples are. Keeps no reference to
  // its arguments.
  void build(const TargetSamples& samples, const std::vector<Eigen::Vector3f>& directions,
             std::size_t bin_count, AlignedFloats& xi, AlignedVector<std::int32_t>& bins,
             BinSpacing spacing = BinSpacing::even);

  // What build() found, and back again, for the same directions and number of even bins.
  void keep(BinnedTarget& binned) const;
  void rebuild(const BinnedTarget& binned, const std::vector<Eigen::Vector3f>& directions,
               std::size_t bin_count);

  std::size_t direction_count() const { return maps_.size(); }
  std::size_t bin_count() const { return bin_count_; }
  const kernels::ProjectionMap& map(std::size_t direction) const { return maps_[direction]; }

  // Mean absolute deviation of the target's projections, averaged over the directions.
  double spread() const { return spread_; }

  kernels::TargetCells cells(std::size_t direction) const;

 private:
  void reserve(std::size_t directions, std::size_t bin_count, BinSpacing spacing);
  void cut_into_cells(std::size_t direction);

  std::size_t bin_count_ = 0;
  BinSpacing spacing_ = BinSpacing::even;
  double spread_ = 0;
  bool heavy_tails_ = true;
  std::vector<kernels::ProjectionMap> maps_;
  std::vector<double> unit_edges_;
  // Direction-major, see kernels::TargetCells; `mass_` one longer a direction than the others.
  AlignedFloats mass_, moment_, inverse_width_, c1_, c2_, c3_;
  AlignedVector<std::int32_t> first_cell_;
  // kernels::TargetCells::first_tail and last_tail, one a direction.
  std::vector<float> first_tail_, last_tail_;
  AlignedFloats sums_;   // pairs (w, w xi), direction-major
  AlignedFloats pairs_;  // of the samples
};

// Of so many numbers: nine, or twelve of folded lobes.
template <int numbers>
struct ModelValueOf {
  double loss = 0;
  Eigen::Matrix<double, numbers, 1> gradient;         // with respect to P, row-major
  Eigen::Matrix<double, numbers, numbers> curvature;  // symmetric, positive semidefinite
};
using ModelValue = ModelValueOf<9>;
// Of a folded lobe (ltc/folded.h): with respect to the 3 x 4 matrix (P q), row-major, that takes
// (A omega_o, u) to the lobe, q = P (0, alpha_y k, g).
using FoldedModelValue = ModelValueOf<12>;

// Everything an evaluation writes to; one a thread, reused from entry to entry.
struct ModelWorkspace {
  void reserve(std::size_t samples, std::size_t bin_count, std::size_t columns = 3);

  AlignedFloats gx, gy, gz, rows, xi, sums, scratch;
  AlignedVector<std::int32_t> bins, populations, counts;
};

// Where the model is evaluated: at P, with samples of the cosine, along every `direction_stride`-th
// direction of the target. `smoothing` is e above, in units of xi.
struct ModelPoint {
  const LobeFrame& frame;
  const Eigen::Matrix3d& frame_matrix;
  const CosineSet& cosines;
  const TargetQuantiles& target;
  std::size_t direction_stride;
  double smoothing;
};
void evaluate_model(const ModelPoint& point, ModelWorkspace& workspace, ModelValue& value);

// The same of a folded lobe: its q, and u of every sample.
struct FoldedColumn {
  Eigen::Vector3d q;
  const AlignedFloats& u;
};
void evaluate_model(const ModelPoint& point, const FoldedColumn& fold, ModelWorkspace& workspace,
                    FoldedModelValue& value);

// The fold of a lobe as its frame sees it: alpha_y k, and g.
using Bend = Eigen::Vector2d;
inline Eigen::Vector3d column_of(const Eigen::Matrix3d& frame_matrix, const Bend& bend) {
  return frame_matrix.rightCols<2>() * bend;
}
// With respect to P, row-major, then the bend.
using BentModelValue = ModelValueOf<11>;
BentModelValue bent(const FoldedModelValue& of_columns, const Eigen::Matrix3d& frame_matrix,
                    const Bend& bend);

}  // namespace ltc
