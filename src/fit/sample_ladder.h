// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The sample sets of a Gauss-Newton fit, from coarse to fine, and how to descend with each.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/gauss_newton.h"
#include "fit/sample_sets.h"
#include "fit/settings.h"

namespace ltc {

// A cosine set, shared by all entries, and how to descend with it.
struct SampleLevel {
  CosineSet cosines;
  DescentOptions options;
  AlignedFloats u;  // of the cosines, where there are creases
};

struct SampleLadder {
  SampleLevel coarse;
  std::vector<SampleLevel> levels;  // ascending
  BinSpacing spacing = BinSpacing::even;
  // Of the target: for the last level, and for all below. Equally weighted with even bins, graded
  // with graded ones.
  TargetLattice lattice, light_lattice;
  GradedLattice graded_lattice, graded_light_lattice;
};

// For most lobes: equally weighted samples, up to as many as the settings say.
SampleLadder make_ladder(const GaussNewtonSettings& settings, const Creases& creases = {},
                         HorizonMode horizon = HorizonMode::clipped);

// For sharp and for extreme lobes. The tails of sharp lobes are so heavy that with equally weighted
// samples the outermost one alone makes up per cents of the loss: the fit follows its noise. Graded
// sets have a thousand times lighter ones out there. Besides, each level draws the target from the
// very lattice of its cosine set: to first order P0 sends a cosine sample to where the visible
// normal of the same lattice point reflects, so that what noise is left is the same on both sides.
SampleLadder make_graded_ladder(const GaussNewtonSettings& settings, const Creases& creases = {},
                                HorizonMode horizon = HorizonMode::clipped);

// The first level that has samples enough for a lobe whose loss is this share of its spread.
std::size_t level_for(const SampleLadder& ladder, double relative_loss);

// Into how many blocks of neighbouring quantiles a direction is cut for so many samples, a multiple
// of 16: finer ones stop paying and coarser ones begin to blur the tails.
std::size_t bins_for(int samples);

}  // namespace ltc
