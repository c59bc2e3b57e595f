// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "config/draft.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/angle.h"

namespace ltc::config {
namespace {

// The degrees that `radians` turns into exactly this angle, if any; of several the shortest to
// write.
double degrees(double angle) {
  const double near = angle / radians_per_degree;
  // A few digits less undo the rounding of the product: 89.991 rather than 89.99100000000001.
  for (int digits = 1; digits <= 17; ++digits)
    if (const double rounded = std::stod(fmt::format("{:.{}g}", near, digits));
        radians_of_degrees(rounded) == angle)
      return rounded;
  for (const double direction : {0.0, 180.0})
    if (const double next = std::nextafter(near, direction); radians_of_degrees(next) == angle)
      return next;
  return near;
}

AxisSettings settings_of(const Axis& axis) {
  return {axis.first(), axis.last(), static_cast<int>(axis.size()), axis.warp};
}

AxisSettings settings_in_degrees(const Axis& axis) {
  AxisSettings settings = settings_of(axis);
  settings.first = degrees(settings.first);
  settings.last = degrees(settings.last);
  return settings;
}

Axis axis_of(const AxisSettings& settings) {
  return Axis::make(settings.first, settings.last, static_cast<std::size_t>(settings.nodes),
                    settings.warp);
}

Axis axis_of_degrees(AxisSettings settings) {
  settings.first = radians_of_degrees(settings.first);
  settings.last = radians_of_degrees(settings.last);
  return axis_of(settings);
}

}  // namespace

Draft draft_of(const Config& config) {
  return {config, settings_of(config.grid.alpha), settings_of(config.grid.lambda),
          settings_in_degrees(config.grid.theta), settings_in_degrees(config.grid.phi)};
}

Config config_of(const Draft& draft) {
  Config config = draft.config;
  config.field.creases = config.fit.creases();
  config.refine.sampling.horizon = config.fit.horizon;
  if (config.fit.lobe == LobeKind::folded)
    config.storage = Storage::folded;
  config.grid.alpha = axis_of(draft.alpha);
  config.grid.lambda = axis_of(draft.lambda);
  config.grid.theta = axis_of_degrees(draft.theta_degrees);
  config.grid.phi = axis_of_degrees(draft.phi_degrees);
  return config;
}

}  // namespace ltc::config
