// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/query_meter.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/random.h"

namespace ltc {
namespace {

// Directions are cheap to make, and the more there are, the less of their noise is fitted.
constexpr std::size_t sets_of_arcs = 64, sets_of_samples = 8;
// Along an arc.
constexpr std::size_t arc_nodes = 6;
constexpr std::size_t bins = 32;
// Below this share of the loss a residual counts as zero.
constexpr double smoothing_share = 0.05;

Eigen::Matrix3d random_rotation(Random& random) {
  const Eigen::Quaterniond turn(random.normal(), random.normal(), random.normal(), random.normal());
  return turn.normalized().toRotationMatrix();
}

}  // namespace

QueryMeter::QueryMeter(const QuerySampling& sampling, double shift, const Creases& creases)
    : loss_(sampling.horizon == HorizonMode::clipped && creases.empty() ? sampling.loss
                                                                        : LossKind::samples),
      rule_(static_cast<std::size_t>(sampling.thresholds), arc_nodes) {
  Random random(static_cast<std::uint64_t>(shift * 0x1p32));
  const std::size_t set_count = by_arcs() ? sets_of_arcs : sets_of_samples;
  for (std::size_t set = 0; set < set_count; ++set) {
    const double turned = shift + static_cast<double>(set) / static_cast<double>(set_count);
    const Eigen::Matrix3d rotation = random_rotation(random);
    SampleSet& made = sets_.emplace_back();
    for (const Eigen::Vector3d& d :
         fibonacci_directions(static_cast<std::size_t>(sampling.directions)))
      made.directions.push_back((rotation * d).cast<float>());
    made.lattice = make_target_lattice(static_cast<std::size_t>(sampling.target_samples), turned);
    if (by_arcs())
      continue;
    made.cosines = make_cosine_set(static_cast<std::size_t>(sampling.samples), turned);
    made.cosines.horizon = sampling.horizon;
    if (!creases.empty())
      made.u = crease_distances(made.cosines, creases);
  }
}

double QueryMeter::see(const LobeFrame& frame, std::size_t query, QueryTarget& target,
                       Buffers& buffers) const {
  const SampleSet& set = set_of(query);
  buffers.seen = &target;
  if (loss_ == LossKind::arcs) {
    if (target.arcs.above.empty()) {
      sample_weighted_target(frame, set.lattice, buffers.target);
      set_target(buffers.target, set.directions, rule_, buffers.xi, target.arcs);
    }
    return target.arcs.spread;
  }
  if (!target.binned.values.empty()) {
    buffers.quantiles.rebuild(target.binned, set.directions, bins);
    return buffers.quantiles.spread();
  }
  sample_weighted_target(frame, set.lattice, buffers.target);
  buffers.quantiles.build(buffers.target, set.directions, bins, buffers.model.xi,
                          buffers.model.bins);
  buffers.quantiles.keep(target.binned);
  return buffers.quantiles.spread();
}

void QueryMeter::measure(const LobeFrame& frame, std::size_t query, const Eigen::Matrix3d& p,
                         double expected, Buffers& buffers, ModelValue& value) const {
  const SampleSet& set = set_of(query);
  if (loss_ == LossKind::arcs)
    measure(point_of_frame(frame, p), query, expected, buffers, value);
  else
    evaluate_model({frame, p, set.cosines, buffers.quantiles, 1, smoothing_share * expected},
                   buffers.model, value);
}

void QueryMeter::measure(const ArcPoint& point, std::size_t query, double expected,
                         Buffers& buffers, ModelValue& value) const {
  evaluate_arcs(point, {set_of(query).directions, rule_, buffers.seen->arcs},
                smoothing_share * expected, buffers.arcs, value);
}

void QueryMeter::measure(const LobeFrame& frame, std::size_t query, const Eigen::Matrix3d& p,
                         const Eigen::Vector3d& q, double expected, Buffers& buffers,
                         FoldedModelValue& value) const {
  const SampleSet& set = set_of(query);
  evaluate_model({frame, p, set.cosines, buffers.quantiles, 1, smoothing_share * expected},
                 {q, set.u}, buffers.model, value);
}

std::size_t QueryMeter::target_bytes(const QuerySampling& sampling) {
  const std::size_t numbers = 2 + std::max(2 * bins, static_cast<std::size_t>(sampling.thresholds));
  return sizeof(QueryTarget) +
         static_cast<std::size_t>(sampling.directions) * numbers * sizeof(float);
}

}  // namespace ltc
