// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/queries.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace ltc {
namespace {

double between(double first, double last, double uniform) {
  return first + (last - first) * uniform;
}

}  // namespace

Lobe query_lobe(const QueryRange& range, const std::array<double, 4>& uniforms, double alpha_min,
                const LobeModel& model) {
  const double roughness = between(range.roughness_first, range.roughness_last, uniforms[0]);
  const double alpha = roughness * roughness;
  const double lambda = between(range.lambda_first, range.lambda_last, uniforms[1]);
  const double cos_theta = between(range.cos_theta_first, range.cos_theta_last, uniforms[2]);
  return {std::max(alpha, alpha_min), std::max(lambda * alpha, alpha_min), std::acos(cos_theta),
          between(range.phi_first, range.phi_last, uniforms[3]), &model};
}

std::vector<Lobe> random_queries(const QueryRange& range, std::size_t count, std::uint64_t seed,
                                 double alpha_min, const LobeModel& model) {
  Random random(seed);
  std::vector<Lobe> queries;
  queries.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<double, 4> uniforms;
    for (double& uniform : uniforms)
      uniform = random.uniform();
    queries.push_back(query_lobe(range, uniforms, alpha_min, model));
  }
  return queries;
}

std::vector<std::array<double, 4>> lattice_points(std::size_t first, std::size_t count) {
  // The real root of x^5 = x + 1.
  constexpr double ratio = 1.1673039782614187;
  std::vector<std::array<double, 4>> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    double step = 1;
    for (double& coordinate : points[i]) {
      step /= ratio;
      const double position = 0.5 + static_cast<double>(first + i + 1) * step;
      coordinate = position - std::floor(position);
    }
  }
  return points;
}

std::vector<Lobe> lattice_queries(const QueryRange& range, std::size_t first, std::size_t count,
                                  double alpha_min, const LobeModel& model) {
  std::vector<Lobe> queries;
  queries.reserve(count);
  for (const std::array<double, 4>& point : lattice_points(first, count))
    queries.push_back(query_lobe(range, point, alpha_min, model));
  return queries;
}

}  // namespace ltc
