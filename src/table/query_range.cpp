// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/query_range.h"

#include <cmath>

#include "table/reduction.h"

namespace ltc {
namespace {

double clamped_roughness(const Axis& alpha, double roughness) {
  const double clamped = clamped_to_roughness_axis(alpha, roughness * roughness);
  return clamped == roughness * roughness ? roughness : std::sqrt(clamped);
}

double clamped_cos_theta(const Axis& theta, double cos_theta) {
  const double radians = std::acos(cos_theta);
  const double clamped = clamped_to_angle_axis(theta, radians);
  return clamped == radians ? cos_theta : std::cos(clamped);
}

// All that the axes hold. A table that turns lobes serves every azimuth.
QueryRange range_of_axes(const Grid& grid) {
  QueryRange range{std::sqrt(grid.alpha.first()), std::sqrt(grid.alpha.last()),
                   grid.lambda.first(),           grid.lambda.last(),
                   std::cos(grid.theta.last()),   std::cos(grid.theta.first())};
  if (!Reduction(grid).turns()) {
    range.phi_first = grid.phi.first();
    range.phi_last = grid.phi.last();
  }
  return range;
}

}  // namespace

QueryRange clamped_range(const Grid& grid, const QueryRange& range) {
  QueryRange result = range;
  for (double* roughness : {&result.roughness_first, &result.roughness_last})
    *roughness = clamped_roughness(grid.alpha, *roughness);
  for (double* lambda : {&result.lambda_first, &result.lambda_last})
    *lambda = clamped_to_roughness_axis(grid.lambda, *lambda);
  for (double* cos_theta : {&result.cos_theta_first, &result.cos_theta_last})
    *cos_theta = clamped_cos_theta(grid.theta, *cos_theta);
  if (!Reduction(grid).turns())
    for (double* phi : {&result.phi_first, &result.phi_last})
      *phi = clamped_to_angle_axis(grid.phi, *phi);
  return result;
}

QueryRange query_range_of(const Grid& grid, const QueryRange& wanted) {
  QueryRange result = clamped_range(grid, wanted);
  const QueryRange axes = range_of_axes(grid);
  const auto restore = [&](double QueryRange::*first, double QueryRange::*last) {
    if (result.*first == result.*last && wanted.*first != wanted.*last) {
      result.*first = axes.*first;
      result.*last = axes.*last;
    }
  };
  restore(&QueryRange::roughness_first, &QueryRange::roughness_last);
  restore(&QueryRange::lambda_first, &QueryRange::lambda_last);
  restore(&QueryRange::cos_theta_first, &QueryRange::cos_theta_last);
  restore(&QueryRange::phi_first, &QueryRange::phi_last);
  return result;
}

}  // namespace ltc
