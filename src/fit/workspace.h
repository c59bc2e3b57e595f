// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The buffers that fits reuse (see solver.h).
#pragma once

#include "core/aligned.h"
#include "fit/arc_model.h"
#include "fit/quantile_model.h"
#include "fit/sample_sets.h"
#include "fit/solver.h"

namespace ltc {

struct FitWorkspace {
  TargetSamples target;
  TargetQuantiles quantiles;
  ModelWorkspace model;
  ArcTarget arc_target;
  ArcWorkspace arcs;
  // Of the stochastic descent.
  TargetLattice lattice;
  AlignedFloats cosine_x, cosine_y, cosine_z, sorted_target, sorted_projections;
  AlignedVector<std::uint64_t> keys;
};

}  // namespace ltc
