// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Gauss's quadrature, by the roots of Legendre's polynomials.
#pragma once

#include <vector>

namespace ltc {

struct GaussNode {
  double place, weight;
};

// On (-1, 1), weights adding up to 2: exact for polynomials of up to twice as many degrees as there
// are nodes, less one. By Newton's method on the recurrence of the polynomials.
std::vector<GaussNode> gauss_nodes(std::size_t count);

// The same on (0, 1), weights adding up to 1.
std::vector<GaussNode> gauss_nodes_of_unit(std::size_t count);

}  // namespace ltc
