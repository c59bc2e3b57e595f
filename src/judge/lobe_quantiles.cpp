// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/lobe_quantiles.h"

#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <cmath>

#include "core/ordered_float.h"

namespace ltc {
namespace {

// Shifts of the sample sets: others than those of the fits.
constexpr double cosine_shift = 0.381, lattice_shift = 0.577;

}  // namespace

LobeQuantiles::LobeQuantiles(std::size_t samples, std::size_t directions, std::size_t blocks)
    : blocks_(blocks),
      cosines_(make_cosine_set(samples, cosine_shift)),
      lattice_(make_target_lattice(samples, lattice_shift)) {
  directions_ = in_float(fibonacci_directions(directions));
  for (AlignedFloats* array : {&gx_, &gy_, &gz_, &projections_})
    array->resize(cosines_.size());
  keys_.resize(lattice_.size());
}

void LobeQuantiles::of_ggx(const LobeFrame& frame, float* quantiles) {
  sample_weighted_target(frame, lattice_, target_);
  const std::size_t count = lattice_.size();
  double total = 0;
  for (std::size_t i = 0; i < count; ++i)
    total += target_.weight[i];
  hwy::Sorter sorter;
  const double mass_of_block = total / static_cast<double>(blocks_);
  for (const Eigen::Vector3f& d : directions_) {
    for (std::size_t i = 0; i < count; ++i)
      keys_[i] = sort_key(d.x() * target_.gx[i] + d.y() * target_.gy[i] + d.z() * target_.gz[i],
                          static_cast<std::uint32_t>(i));
    sorter(keys_.data(), count, hwy::SortAscending());
    // A sample that straddles the end of a block is shared between the blocks.
    std::size_t i = 0;
    double left = target_.weight[key_index(keys_[0])];
    for (std::size_t block = 0; block < blocks_; ++block) {
      double wanted = mass_of_block, sum = 0;
      while (wanted > 0) {
        const bool last = i + 1 == count;
        const double taken = last ? wanted : std::min(wanted, left);
        sum += taken * key_value(keys_[i]);
        wanted -= taken;
        left -= taken;
        if (left <= 0 && !last)
          left = target_.weight[key_index(keys_[++i])];
      }
      *quantiles++ = static_cast<float>(sum / mass_of_block);
    }
  }
}

void LobeQuantiles::of_ltc(const LobeFrame& frame, const LtcLobe& ltc, float* quantiles) {
  const Eigen::Matrix3d p = frame.rotation.transpose() * ltc.matrix;
  const std::size_t count = cosines_.size();
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d at(cosines_.x[i], cosines_.y[i], cosines_.z[i]);
    if (!ltc.creases.empty())
      at = folded(at, ltc.fold, ltc.creases);
    const Eigen::Vector3d f = p * at;
    const double lateral = f.x() * f.x() + f.y() * f.y(),
                 length = std::sqrt(lateral + f.z() * f.z());
    gx_[i] = static_cast<float>(f.x() / length);
    gy_[i] = static_cast<float>(f.y() / length);
    // f_z/|f| - 1 without its cancellation near the axis.
    gz_[i] =
        static_cast<float>(f.z() > 0 ? -lateral / (length * (length + f.z())) : f.z() / length - 1);
  }
  hwy::Sorter sorter;
  for (const Eigen::Vector3f& d : directions_) {
    for (std::size_t i = 0; i < count; ++i)
      projections_[i] = d.x() * gx_[i] + d.y() * gy_[i] + d.z() * gz_[i];
    sorter(projections_.data(), count, hwy::SortAscending());
    for (std::size_t block = 0; block < blocks_; ++block) {
      const std::size_t first = block * count / blocks_, end = (block + 1) * count / blocks_;
      double sum = 0;
      for (std::size_t i = first; i < end; ++i)
        sum += projections_[i];
      *quantiles++ = static_cast<float>(sum / static_cast<double>(end - first));
    }
  }
}

double LobeQuantiles::distance(const float* a, const float* b) const {
  double sum = 0;
  for (std::size_t first = 0; first < size(); first += blocks_)
    for (std::size_t i = first + 1; i + 1 < first + blocks_; ++i)
      sum += std::abs(static_cast<double>(a[i]) - b[i]);
  return sum / static_cast<double>(size());
}

double LobeQuantiles::spread(const float* quantiles) const {
  double sum = 0;
  for (std::size_t first = 0; first < size(); first += blocks_) {
    const double median = quantiles[first + blocks_ / 2];
    for (std::size_t i = first; i < first + blocks_; ++i)
      sum += std::abs(quantiles[i] - median);
  }
  return sum / static_cast<double>(size());
}

}  // namespace ltc
