// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How the loss of a query is measured: along few directions, of one of several sets, against a
// target that is counted or binned once and kept.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "fit/arc_model.h"
#include "fit/quantile_model.h"
#include "ltc/folded.h"
#include "refine/refine_settings.h"

namespace ltc {

// What is kept of a query's target: one of these.
struct QueryTarget {
  ArcTarget arcs;
  BinnedTarget binned;
};

class QueryMeter {
 public:
  // Meters of different `shift` in [0, 1) share no samples. With creases, of folded lobes.
  QueryMeter(const QuerySampling& sampling, double shift, const Creases& creases = {});

  // Whether distributions are found by arcs.
  bool by_arcs() const { return loss_ == LossKind::arcs; }

  // One a thread.
  struct Buffers {
    TargetSamples target;
    AlignedFloats xi;
    ArcWorkspace arcs;
    TargetQuantiles quantiles;
    ModelWorkspace model;
    const QueryTarget* seen = nullptr;
  };

  // Sets the lobe that measure() judges against, by set number `query` modulo that of the sets, so
  // that neighbours are measured with different ones. `target` is made the first time and read from
  // then on, measure() included. Returns the lobe's spread.
  double see(const LobeFrame& frame, std::size_t query, QueryTarget& target,
             Buffers& buffers) const;

  // The loss' model at P in the frame (not divided by the spread); residuals below a share of the
  // loss that is `expected` count as zero. After see() with the same frame and query.
  void measure(const LobeFrame& frame, std::size_t query, const Eigen::Matrix3d& p, double expected,
               Buffers& buffers, ModelValue& value) const;

  // The same with respect to what a point is of, by arcs.
  void measure(const ArcPoint& point, std::size_t query, double expected, Buffers& buffers,
               ModelValue& value) const;

  // The same of a folded lobe; `q` as in FoldedColumn.
  void measure(const LobeFrame& frame, std::size_t query, const Eigen::Matrix3d& p,
               const Eigen::Vector3d& q, double expected, Buffers& buffers,
               FoldedModelValue& value) const;

  // What a kept target takes.
  static std::size_t target_bytes(const QuerySampling& sampling);

 private:
  struct SampleSet {
    std::vector<Eigen::Vector3f> directions;
    TargetLattice lattice;
    CosineSet cosines;  // where there are samples of the LTC
    AlignedFloats u;    // of the cosines, where there are creases
  };
  const SampleSet& set_of(std::size_t query) const { return sets_[query % sets_.size()]; }

  LossKind loss_;
  ArcRule rule_;
  std::vector<SampleSet> sets_;
};

}  // namespace ltc
