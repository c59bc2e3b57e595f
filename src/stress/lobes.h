// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The lobes of a stress run: the edges of what a table asks for, and beyond them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "brdf/ggx.h"

namespace ltc {

// A lobe as a person names it. alpha_y = lambda alpha_x, in (0, 1] both; theta in [0, 90).
struct StressLobe {
  double alpha = 1, lambda = 1;
  double theta_degrees = 0, phi_degrees = 0;
  bool on_grid = false;  // of stress_grid, else drawn at random
  const LobeModel* model = &ggx();

  // Bit for bit what `ltcfit fit` makes of the same numbers.
  Lobe lobe() const;
};

// Node values of a regular grid, ascending.
struct StressAxes {
  std::vector<double> alpha, lambda, theta_degrees, phi_degrees;

  std::size_t size() const {
    return alpha.size() * lambda.size() * theta_degrees.size() * phi_degrees.size();
  }
};

// How finely the same ranges are covered.
enum class StressDensity {
  full,    // every decade of alpha and lambda from 1e-6 to 1
  coarse,  // every other decade, phi between the mirror planes: for solvers that take long
  quick,   // every third decade: for tests
};
StressAxes stress_axes(StressDensity density);

// All combinations, phi running fastest, then theta, lambda, alpha.
std::vector<StressLobe> grid_lobes(const StressAxes& axes);

// Lobes of the same ranges: alpha and lambda uniform in the logarithm, theta uniform or crowded
// towards 90 degrees, phi uniform or crowded towards 0 or 90 degrees.
std::vector<StressLobe> random_lobes(std::size_t count, std::uint64_t seed);

// Those that a model has, with that model: lobes of two roughnesses that it refuses are replaced by
// the one of the larger, if that is none of them already; others that it refuses are left out.
std::vector<StressLobe> lobes_of_model(const std::vector<StressLobe>& lobes,
                                       const LobeModel& model);

}  // namespace ltc
