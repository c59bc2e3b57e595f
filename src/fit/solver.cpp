// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/solver.h"

#include "fit/gauss_newton_solver.h"
#include "fit/l3_nelder_mead.h"
#include "fit/sgd_solver.h"
#include "fit/workspace.h"

namespace ltc {

void FitWorkspaceDeleter::operator()(FitWorkspace* workspace) const {
  delete workspace;
}

FitWorkspacePointer make_fit_workspace() {
  return FitWorkspacePointer(new FitWorkspace);
}

std::unique_ptr<Solver> make_solver(const FitSettings& settings) {
  switch (settings.solver) {
    case SolverKind::sgd:
      return std::make_unique<SgdSolver>(settings.sgd, settings.target);
    case SolverKind::l3_nelder_mead:
      return std::make_unique<L3NelderMeadSolver>(settings.l3);
    case SolverKind::gauss_newton:
      break;
  }
  return std::make_unique<GaussNewtonSolver>(settings.gauss_newton, settings.target,
                                             settings.creases(), settings.horizon);
}

}  // namespace ltc
