// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The lobes that a look-up folds to one and the same node.
#pragma once

#include <array>
#include <numbers>

#include "brdf/ggx.h"

namespace ltc::testing {

// Equations (13) to (15): the node itself, alpha_x >= alpha_y and phi in [0, pi/2], in all four
// quadrants, then each with its roughnesses swapped.
inline std::array<Lobe, 8> lobes_that_fold_to(const Lobe& node) {
  constexpr double pi = std::numbers::pi;
  const auto [alpha, smaller, theta, phi, model] = node;
  return {{{alpha, smaller, theta, phi, model},
           {alpha, smaller, theta, pi - phi, model},
           {alpha, smaller, theta, pi + phi, model},
           {alpha, smaller, theta, 2 * pi - phi, model},
           {smaller, alpha, theta, pi / 2 - phi, model},
           {smaller, alpha, theta, pi / 2 + phi, model},
           {smaller, alpha, theta, 3 * pi / 2 - phi, model},
           {smaller, alpha, theta, 3 * pi / 2 + phi, model}}};
}

}  // namespace ltc::testing
