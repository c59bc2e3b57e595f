// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "brdf/gauss_rule.h"

#include <cmath>
#include <numbers>

namespace ltc {

// The roots of Legendre's polynomial, from Chebyshev's on.
GaussRule::GaussRule(std::size_t points) {
  const auto n = static_cast<double>(points);
  for (std::size_t i = 0; i < points; ++i) {
    double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 8; ++step) {
      double last = 1, value = x;  // the polynomials of two degrees
      for (std::size_t k = 2; k <= points; ++k) {
        const auto degree = static_cast<double>(k);
        const double next = ((2 * degree - 1) * x * value - (degree - 1) * last) / degree;
        last = value;
        value = next;
      }
      slope = n * (x * value - last) / (x * x - 1);
      x -= value / slope;
    }
    place.push_back((1 + x) / 2);
    weight.push_back(1 / ((1 - x * x) * slope * slope));
  }
}

}  // namespace ltc
