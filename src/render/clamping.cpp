// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/clamping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angle.h"
#include "table/reduction.h"

namespace ltc {
std::vector<ClampedAxis> clamped_axes(const Grid& grid, const SphereMaterial& material) {
  constexpr double right_angle = std::numbers::pi / 2;
  const auto [smaller, larger] = std::minmax(material.alpha_x, material.alpha_y);
  std::vector<ClampedAxis> result;
  const auto check = [&](std::size_t axis, std::initializer_list<double> values, auto&& clamped_to,
                         double unit) {
    const std::string name(grid.axis_names()[axis]);
    ClampedAxis worst{name, 0, 0};
    for (const double value : values) {
      const double taken = clamped_to(grid.axis(axis), value);
      if (std::abs(value - taken) > std::abs(worst.asked - worst.taken) * unit)
        worst = {name, value / unit, taken / unit};
    }
    if (worst.asked != worst.taken)
      result.push_back(worst);
  };
  const bool both = grid.layout == Layout::alphax_alphay;
  check(0, {both ? material.alpha_x : larger}, clamped_to_roughness_axis, 1);
  check(1, {both ? material.alpha_y : smaller / larger}, clamped_to_roughness_axis, 1);
  check(2, {0, right_angle}, clamped_to_angle_axis, radians_per_degree);
  if (smaller != larger)
    check(3, {0, right_angle}, clamped_to_angle_axis, radians_per_degree);
  return result;
}

std::string clamping_text(const std::vector<ClampedAxis>& clamped) {
  std::string text;
  for (const auto& [axis, asked, taken] : clamped)
    text += fmt::format("{}{} {:.4g} to {:.4g}", text.empty() ? "" : ", ", axis, asked, taken);
  return text;
}

}  // namespace ltc
