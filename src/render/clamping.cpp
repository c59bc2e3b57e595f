// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/clamping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angle.h"

namespace ltc {
namespace {

double clamped_to(const Axis& axis, double value) {
  constexpr double no_matter = 1e-3;
  if (value >= axis.first() - no_matter && value <= axis.last() + no_matter)
    return value;
  return std::clamp(value, axis.first(), axis.last());
}

}  // namespace

std::vector<ClampedAxis> clamped_axes(const Grid& grid, const SphereMaterial& material) {
  constexpr double right_angle = std::numbers::pi / 2;
  const auto [smaller, larger] = std::minmax(material.alpha_x, material.alpha_y);
  std::vector<ClampedAxis> result;
  const auto check = [&](const char* name, const Axis& axis, std::initializer_list<double> values,
                         double unit) {
    ClampedAxis worst{name, 0, 0};
    for (const double value : values) {
      const double taken = clamped_to(axis, value);
      if (std::abs(value - taken) > std::abs(worst.asked - worst.taken) * unit)
        worst = {name, value / unit, taken / unit};
    }
    if (worst.asked != worst.taken)
      result.push_back(worst);
  };
  check("alpha", grid.alpha, {larger}, 1);
  check("lambda", grid.lambda, {smaller / larger}, 1);
  check("theta", grid.theta, {0, right_angle}, radians_per_degree);
  if (smaller != larger)
    check("phi", grid.phi, {0, right_angle}, radians_per_degree);
  return result;
}

std::string clamping_text(const std::vector<ClampedAxis>& clamped) {
  std::string text;
  for (const auto& [axis, asked, taken] : clamped)
    text += fmt::format("{}{} {:.4g} to {:.4g}", text.empty() ? "" : ", ", axis, asked, taken);
  return text;
}

}  // namespace ltc
