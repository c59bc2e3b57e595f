// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/held_out.h"

#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "judge/quantile_kernels.h"

namespace ltc {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// A projection direction in the frame of the offsets.
Eigen::Vector3f in_frame(const LobeFrame& frame, const Eigen::Vector3d& direction) {
  return (frame.rotation.transpose() * direction).cast<float>();
}

void project(const Eigen::Vector3f& direction, const AlignedFloats& x, const AlignedFloats& y,
             const AlignedFloats& z, AlignedFloats& projections) {
  kernels::project(direction.data(), {x.data(), y.data(), z.data(), projections.size()},
                   projections.data());
}

}  // namespace

HeldOutJudge::HeldOutJudge(std::size_t samples, std::size_t directions, std::uint64_t seed,
                           HorizonMode horizon)
    : horizon_(horizon),
      cosines_(make_cosine_set(samples, 0.237 + 1e-3 * static_cast<double>(seed % 997))),
      lattice_(make_target_lattice(samples, 0.713 + 1e-3 * static_cast<double>(seed % 991))),
      directions_(turned_directions(directions, seed)) {
  const std::size_t count = cosines_.size();
  keys_.resize(count);
  for (AlignedFloats* array : {&points_.x, &points_.y, &points_.z, &points_b_.x, &points_b_.y,
                               &points_b_.z, &sorted_, &sorted_b_})
    array->resize(count);
}

void HeldOutJudge::sample_target(const LobeFrame& frame) {
  sample_weighted_target(frame, lattice_, target_);
  target_total_ = 0;
  target_largest_ = 0;
  for (std::size_t i = 0; i < target_.size; ++i) {
    target_total_ += static_cast<double>(target_.weight[i]);
    target_largest_ = std::max(target_largest_, target_.weight[i]);
  }
}

void HeldOutJudge::sort_target(const Eigen::Vector3f& direction, const hwy::Sorter& sorter,
                               QuantileCells& cells) {
  project(direction, target_.gx, target_.gy, target_.gz, sorted_);
  for (std::size_t i = 0; i < keys_.size(); ++i)
    keys_[i] = QuantileCells::key(sorted_[i], target_.weight[i]);
  sorter(keys_.data(), keys_.size(), hwy::SortAscending());
  cells.build(keys_, target_total_, target_largest_);
}

void HeldOutJudge::transform(const LobeFrame& frame, const LtcLobe& ltc, HorizonMode horizon,
                             Points& points) const {
  const Eigen::Matrix3d p = frame.from_matrix(ltc.matrix) * frame.widths.asDiagonal();
  const double p00 = p(0, 0), p01 = p(0, 1), p02 = p(0, 2);
  const double p10 = p(1, 0), p11 = p(1, 1), p12 = p(1, 2);
  const double p20 = p(2, 0), p21 = p(2, 1), p22 = p(2, 2);
  const Eigen::RowVector3d up = ltc.matrix.row(2);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cosines_.size(); ++i) {
    Eigen::Vector3d at(cosines_.x[i], cosines_.y[i], cosines_.z[i]);
    if (!ltc.creases.empty())
      at = folded(at, ltc.fold, ltc.creases);
    if (horizon == HorizonMode::scaled && up.dot(at) <= 0)
      continue;
    const double x = at.x(), y = at.y(), z = at.z();
    const double fx = p00 * x + p01 * y + p02 * z;
    const double fy = p10 * x + p11 * y + p12 * z;
    const double fz = p20 * x + p21 * y + p22 * z;
    const double lateral = fx * fx + fy * fy, length = std::sqrt(lateral + fz * fz);
    points.x[kept] = static_cast<float>(fx / length);
    points.y[kept] = static_cast<float>(fy / length);
    // fz / |f| - 1, without cancellation in front.
    points.z[kept] =
        static_cast<float>(fz > 0 ? -lateral / (length * (length + fz)) : fz / length - 1);
    ++kept;
  }
  points.count = kept;
  if (kept == 0)
    transform(frame, ltc, HorizonMode::clipped, points);
}

void HeldOutJudge::sort_points(const Eigen::Vector3f& direction, const Points& points,
                               const hwy::Sorter& sorter, AlignedFloats& sorted) {
  project(direction, points.x, points.y, points.z, sorted);
  sorter(sorted.data(), points.count, hwy::SortAscending());
}

void HeldOutJudge::set_lobe(const Lobe& lobe) {
  frame_.emplace(lobe);
  sample_target(*frame_);
  cells_.resize(directions_.size());
  spread_ = 0;
  const hwy::Sorter sorter;
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    sort_target(in_frame(*frame_, directions_[k]), sorter, cells_[k]);
    spread_ += cells_[k].spread();
  }
  spread_ /= static_cast<double>(directions_.size());
}

double HeldOutJudge::loss(const LtcLobe& ltc) {
  if (!ltc.matrix.allFinite())
    return none;
  transform(*frame_, ltc, horizon_, points_);
  double distance = 0;
  const hwy::Sorter sorter;
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    sort_points(in_frame(*frame_, directions_[k]), points_, sorter, sorted_);
    distance += cells_[k].distance(sorted_.data(), points_.count);
  }
  return distance / static_cast<double>(directions_.size());
}

PairJudgement HeldOutJudge::judge_pair(const Lobe& lobe, const LtcLobe& a, const LtcLobe& b) {
  const LobeFrame frame(lobe);
  sample_target(frame);
  const bool has_a = a.matrix.allFinite(), has_b = b.matrix.allFinite();
  if (has_a)
    transform(frame, a, horizon_, points_);
  if (has_b)
    transform(frame, b, horizon_, points_b_);
  PairJudgement sum{has_a ? 0 : none, has_b ? 0 : none, has_a && has_b ? 0 : none, 0};
  const hwy::Sorter sorter;
  for (const Eigen::Vector3d& direction : directions_) {
    const Eigen::Vector3f d = in_frame(frame, direction);
    sort_target(d, sorter, pair_cells_);
    sum.spread += pair_cells_.spread();
    if (has_a) {
      sort_points(d, points_, sorter, sorted_);
      sum.loss_a += pair_cells_.distance(sorted_.data(), points_.count);
    }
    if (has_b) {
      sort_points(d, points_b_, sorter, sorted_b_);
      sum.loss_b += pair_cells_.distance(sorted_b_.data(), points_b_.count);
    }
    if (has_a && has_b)
      sum.distance +=
          sorted_distance(sorted_.data(), points_.count, sorted_b_.data(), points_b_.count);
  }
  const auto count = static_cast<double>(directions_.size());
  return {sum.loss_a / count, sum.loss_b / count, sum.distance / count, sum.spread / count};
}

}  // namespace ltc
