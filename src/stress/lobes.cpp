// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "stress/lobes.h"

#include <cmath>

#include "brdf/lobe_model.h"
#include "core/angle.h"
#include "core/error.h"
#include "core/random.h"

namespace ltc {
namespace {

// Powers of ten from 1e-6 to 1, so many decades apart.
std::vector<double> decades(int stride) {
  std::vector<double> values;
  for (int exponent = -6; exponent <= 0; exponent += stride)
    values.push_back(std::pow(10.0, exponent));
  return values;
}

double log_uniform(Random& random, double first_exponent, double last_exponent) {
  return std::pow(10.0, first_exponent + (last_exponent - first_exponent) * random.uniform());
}

// Angles this near to 0 or 90 degrees, in degrees, as powers of ten.
constexpr double nearest_theta = -3, nearest_phi = -7, furthest = 1.5;

double random_theta(Random& random) {
  if (random.uniform() < 0.5)
    return 89.999 * random.uniform();
  return 90 - log_uniform(random, nearest_theta, furthest);
}

double random_phi(Random& random) {
  const double kind = random.uniform();
  if (kind < 0.5)
    return 90 * random.uniform();
  const double distance = log_uniform(random, nearest_phi, furthest);
  return kind < 0.75 ? distance : 90 - distance;
}

}  // namespace

Lobe StressLobe::lobe() const {
  return {alpha, lambda * alpha, radians_of_degrees(theta_degrees), radians_of_degrees(phi_degrees),
          model};
}

StressAxes stress_axes(StressDensity density) {
  switch (density) {
    case StressDensity::coarse:
      return {decades(2), decades(2), {0, 45, 80, 89, 89.999}, {45}};
    case StressDensity::quick:
      return {decades(3), decades(3), {0, 80, 89.999}, {0, 45}};
    case StressDensity::full:
      break;
  }
  return {decades(1), decades(1), {0, 45, 80, 89, 89.999}, {0, 1e-6, 45, 90 - 1e-6, 90}};
}

std::vector<StressLobe> grid_lobes(const StressAxes& axes) {
  std::vector<StressLobe> lobes;
  for (const double alpha : axes.alpha)
    for (const double lambda : axes.lambda)
      for (const double theta : axes.theta_degrees)
        for (const double phi : axes.phi_degrees)
          lobes.push_back({alpha, lambda, theta, phi, true});
  return lobes;
}

std::vector<StressLobe> random_lobes(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<StressLobe> lobes;
  for (std::size_t i = 0; i < count; ++i) {
    const double alpha = log_uniform(random, -6, 0);
    const double lambda = log_uniform(random, -6, 0);
    const double theta = random_theta(random);
    lobes.push_back({alpha, lambda, theta, random_phi(random), false});
  }
  return lobes;
}

std::vector<StressLobe> lobes_of_model(const std::vector<StressLobe>& lobes,
                                       const LobeModel& model) {
  const auto serves = [&](const StressLobe& lobe) {
    try {
      model.require(lobe.lobe());
      return true;
    } catch (const InputError&) {
      return false;
    }
  };
  std::vector<StressLobe> served;
  for (StressLobe lobe : lobes) {
    lobe.model = &model;
    if (serves(lobe)) {
      served.push_back(lobe);
      continue;
    }
    // Those of the grid stand there with every ratio, that of 1 among them.
    const bool has_isotropic_twin = lobe.on_grid;
    lobe.lambda = 1;
    if (!has_isotropic_twin && serves(lobe))
      served.push_back(lobe);
  }
  return served;
}

}  // namespace ltc
