// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// sweep_count of fit/fit_table.h, apart from it: who reads checkpoints needs no solver.
#include "fit/fit_table.h"

namespace ltc {

int sweep_count(const FitSettings& settings) {
  return settings.solver == SolverKind::gauss_newton ? settings.gauss_newton.neighbour_sweeps : 0;
}

}  // namespace ltc
