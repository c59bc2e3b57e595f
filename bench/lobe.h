// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The lobe that all micro-benchmarks work on: ordinary roughness, an oblique view.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "brdf/ggx.h"
#include "fit/lobe_frame.h"
#include "fit/quantile_model.h"
#include "fit/sample_sets.h"
#include "fit/starting_points.h"

namespace ltc::bench {

inline const Lobe lobe{0.43, 0.18, 0.9, 0.6};

// The sets of a phase of the fit, as GaussNewtonSolver makes them.
struct Sets {
  explicit Sets(std::size_t samples, std::size_t direction_count, std::size_t target_samples)
      : cosines(make_cosine_set(samples)),
        lattice(make_target_lattice(target_samples, 0.3)),
        bins(std::clamp<std::size_t>(samples / 64, 32, 256)) {
    directions = in_float(fibonacci_directions(direction_count));
    sample_weighted_target(frame, lattice, target);
    quantiles.build(target, directions, bins, model.xi, model.bins);
    start = first_order_start(frame);
  }

  LobeFrame frame{lobe};
  CosineSet cosines;
  TargetLattice lattice;
  std::size_t bins;
  std::vector<Eigen::Vector3f> directions;
  TargetSamples target;
  TargetQuantiles quantiles;
  ModelWorkspace model;
  Eigen::Matrix3d start;
};

}  // namespace ltc::bench
