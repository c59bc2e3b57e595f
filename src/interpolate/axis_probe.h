// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Which nodes of each axis a lattice needs, found out by fits along some lines of the grid.
#pragma once

#include "interpolate/lattice.h"
#include "interpolate/node_fits.h"

namespace ltc {

// Whether any axis is long enough to be left nodes out of.
bool has_long_axis(const Grid& grid);

struct ProbeSettings {
  std::size_t nodes = 8;    // about so many of an axis to begin with
  std::size_t lines = 24;   // of each axis
  double tolerance = 4e-3;  // of the mean excess in the middle of an interval
};

// Halves the spacing from node to node of each axis where the loss in its middle exceeds that of
// fits of its own by more than the tolerance, in the mean over the lines; every line runs through
// nodes of the coarsest lattice. Axes of at most 12 nodes keep all of them.
LatticeAxes probe_axes(const Grid& grid, const ProbeSettings& settings, NodeFits& fits);

}  // namespace ltc
