// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "validate/held_out.h"

#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/ordered_float.h"

namespace ltc {
namespace {

// int |F^-1 - G^-1| du for `count` equally weighted sorted `x` against sorted `y` whose cumulative
// weights (last one 1) are `cumulative`.
double quantile_distance(const float* x, const float* y, const float* cumulative,
                         std::size_t count) {
  double distance = 0, u = 0;
  const double share = 1.0 / static_cast<double>(count);
  std::size_t i = 0, j = 0;
  while (i < count && j < count) {
    const double next_x = static_cast<double>(i + 1) * share, next_y = cumulative[j];
    const double next = std::min(next_x, next_y);
    distance += (next - u) * std::abs(static_cast<double>(x[i]) - y[j]);
    u = next;
    i += next_x <= next;
    j += next_y <= next;
  }
  return distance;
}

}  // namespace

HeldOutJudge::HeldOutJudge(std::size_t samples, std::size_t directions, std::uint64_t seed)
    : cosines_(make_cosine_set(samples, 0.237 + 1e-3 * static_cast<double>(seed % 997))),
      lattice_(make_target_lattice(samples, 0.713 + 1e-3 * static_cast<double>(seed % 991))),
      directions_(random_directions(directions, seed)) {
  const std::size_t count = cosines_.size();
  sorted_values_.resize(count * directions);
  cumulative_.resize(count * directions);
  keys_.resize(count);
  for (AlignedFloats* array : {&gx_, &gy_, &gz_, &projections_})
    array->resize(count);
}

void HeldOutJudge::set_lobe(const GgxLobe& lobe) {
  frame_.emplace(lobe);
  sample_weighted_target((*frame_), lattice_, target_);
  const std::size_t count = target_.size;
  double total = 0;
  for (std::size_t i = 0; i < count; ++i)
    total += target_.weight[i];
  hwy::Sorter sorter;
  spread_ = 0;
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const Eigen::Vector3f d = (frame_->rotation.transpose() * directions_[k]).cast<float>();
    for (std::size_t i = 0; i < count; ++i) {
      const float projection =
          d.x() * target_.gx[i] + d.y() * target_.gy[i] + d.z() * target_.gz[i];
      keys_[i] = sort_key(projection, static_cast<std::uint32_t>(i));
    }
    sorter(keys_.data(), count, hwy::SortAscending());
    float* values = sorted_values_.data() + k * count;
    float* cumulative = cumulative_.data() + k * count;
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      values[i] = key_value(keys_[i]);
      sum += target_.weight[key_index(keys_[i])];
      cumulative[i] = static_cast<float>(sum / total);
    }
    cumulative[count - 1] = 1.0f;
    const std::size_t middle =
        std::lower_bound(cumulative, cumulative + count - 1, 0.5f) - cumulative;
    double previous = 0;
    for (std::size_t i = 0; i < count; ++i) {
      spread_ += (cumulative[i] - previous) * std::abs(values[i] - values[middle]);
      previous = cumulative[i];
    }
  }
  spread_ /= static_cast<double>(directions_.size());
}

double HeldOutJudge::loss(const Eigen::Matrix3d& matrix) {
  if (!matrix.allFinite())
    return std::numeric_limits<double>::quiet_NaN();
  const LobeFrame& frame = (*frame_);
  const Eigen::Matrix3d p = frame.from_matrix(matrix) *
                            Eigen::Vector3d(frame.lobe.alpha_x, frame.lobe.alpha_y, 1).asDiagonal();
  const std::size_t count = cosines_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d f = p * Eigen::Vector3d(cosines_.x[i], cosines_.y[i], cosines_.z[i]);
    const double lateral = f.x() * f.x() + f.y() * f.y(),
                 length = std::sqrt(lateral + f.z() * f.z());
    gx_[i] = static_cast<float>(f.x() / length);
    gy_[i] = static_cast<float>(f.y() / length);
    gz_[i] =
        static_cast<float>(f.z() > 0 ? -lateral / (length * (length + f.z())) : f.z() / length - 1);
  }
  hwy::Sorter sorter;
  double distance = 0;
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const Eigen::Vector3f d = (frame.rotation.transpose() * directions_[k]).cast<float>();
    for (std::size_t i = 0; i < count; ++i)
      projections_[i] = d.x() * gx_[i] + d.y() * gy_[i] + d.z() * gz_[i];
    sorter(projections_.data(), count, hwy::SortAscending());
    distance += quantile_distance(projections_.data(), sorted_values_.data() + k * count,
                                  cumulative_.data() + k * count, count);
  }
  return distance / static_cast<double>(directions_.size());
}

}  // namespace ltc
