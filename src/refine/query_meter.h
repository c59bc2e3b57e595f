// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How the loss of a query is measured: with few samples, of one of several sets, against a target
// that is binned once and kept.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "fit/quantile_model.h"
#include "ltc/folded.h"
#include "refine/refine_settings.h"

namespace ltc {

class QueryMeter {
 public:
  // Meters of different `shift` in [0, 1) share no samples.
  QueryMeter(const QuerySampling& sampling, double shift);

  // One a thread.
  struct Buffers {
    TargetSamples target;
    TargetQuantiles quantiles;
    ModelWorkspace model;
  };

  // Sets the lobe that measure() judges against, by set number `query` modulo that of the sets, so
  // that neighbours are measured with different ones. `binned` is made the first time and read from
  // then on. Returns the lobe's spread.
  double see(const LobeFrame& frame, std::size_t query, BinnedTarget& binned,
             Buffers& buffers) const;

  // The loss' model at P in the frame (not divided by the spread); residuals below a share of the
  // loss that is `expected` count as zero. After see() with the same frame and query.
  void measure(const LobeFrame& frame, std::size_t query, const Eigen::Matrix3d& p, double expected,
               Buffers& buffers, ModelValue& value) const;

  // The same of a folded lobe, whose samples are folded along these creases; `q` as in
  // FoldedColumn.
  void set_creases(const Creases& creases);
  void measure(const LobeFrame& frame, std::size_t query, const Eigen::Matrix3d& p,
               const Eigen::Vector3d& q, double expected, Buffers& buffers,
               FoldedModelValue& value) const;

  // What a kept target takes.
  static std::size_t target_bytes(const QuerySampling& sampling);

 private:
  struct SampleSet {
    CosineSet cosines;
    TargetLattice lattice;
    std::vector<Eigen::Vector3f> directions;
    AlignedFloats u;  // of the cosines, where there are creases
  };
  const SampleSet& set_of(std::size_t query) const { return sets_[query % sets_.size()]; }

  std::vector<SampleSet> sets_;
};

}  // namespace ltc
