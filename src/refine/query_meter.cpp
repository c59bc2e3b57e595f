// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/query_meter.h"

#include <Eigen/Geometry>

#include "core/random.h"

namespace ltc {
namespace {

constexpr std::size_t set_count = 8;
constexpr std::size_t bins = 32;
// Below this share of the loss a residual counts as zero.
constexpr double smoothing_share = 0.05;

Eigen::Matrix3d random_rotation(Random& random) {
  const Eigen::Quaterniond turn(random.normal(), random.normal(), random.normal(), random.normal());
  return turn.normalized().toRotationMatrix();
}

}  // namespace

QueryMeter::QueryMeter(const QuerySampling& sampling, double shift) {
  Random random(static_cast<std::uint64_t>(shift * 0x1p32));
  for (std::size_t set = 0; set < set_count; ++set) {
    const double turned = shift + static_cast<double>(set) / set_count;
    sets_.push_back({make_cosine_set(static_cast<std::size_t>(sampling.samples), turned),
                     make_target_lattice(static_cast<std::size_t>(sampling.target_samples), turned),
                     {},
                     {}});
    sets_.back().cosines.horizon = sampling.horizon;
    const Eigen::Matrix3d rotation = random_rotation(random);
    for (const Eigen::Vector3d& d :
         fibonacci_directions(static_cast<std::size_t>(sampling.directions)))
      sets_.back().directions.push_back((rotation * d).cast<float>());
  }
}

double QueryMeter::see(const LobeFrame& frame, std::size_t query, BinnedTarget& binned,
                       Buffers& buffers) const {
  const SampleSet& set = set_of(query);
  if (!binned.values.empty()) {
    buffers.quantiles.rebuild(binned, set.directions, bins);
    return buffers.quantiles.spread();
  }
  sample_weighted_target(frame, set.lattice, buffers.target);
  buffers.quantiles.build(buffers.target, set.directions, bins, buffers.model.xi,
                          buffers.model.bins);
  buffers.quantiles.keep(binned);
  return buffers.quantiles.spread();
}

void QueryMeter::measure(const LobeFrame& frame, std::size_t query, const Eigen::Matrix3d& p,
                         double expected, Buffers& buffers, ModelValue& value) const {
  evaluate_model(
      {frame, p, set_of(query).cosines, buffers.quantiles, 1, smoothing_share * expected},
      buffers.model, value);
}

void QueryMeter::set_creases(const Creases& creases) {
  for (SampleSet& set : sets_)
    set.u = crease_distances(set.cosines, creases);
}

void QueryMeter::measure(const LobeFrame& frame, std::size_t query, const Eigen::Matrix3d& p,
                         const Eigen::Vector3d& q, double expected, Buffers& buffers,
                         FoldedModelValue& value) const {
  const SampleSet& set = set_of(query);
  evaluate_model({frame, p, set.cosines, buffers.quantiles, 1, smoothing_share * expected},
                 {q, set.u}, buffers.model, value);
}

std::size_t QueryMeter::target_bytes(const QuerySampling& sampling) {
  return sizeof(BinnedTarget) +
         static_cast<std::size_t>(sampling.directions) * (2 + 2 * bins) * sizeof(float);
}

}  // namespace ltc
