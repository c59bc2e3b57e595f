// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Gauss's quadrature on [0, 1].
#pragma once

#include <cstddef>
#include <vector>

namespace ltc {

// Exact for polynomials of up to twice as many degrees as it has points, less one; to all digits up
// to some hundred points, which are found by Newton's steps.
struct GaussRule {
  explicit GaussRule(std::size_t points);
  std::size_t size() const { return place.size(); }

  std::vector<double> place, weight;  // weights sum to 1
};

}  // namespace ltc
