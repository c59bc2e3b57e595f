// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// One lobe through the pipeline, with all that lies between its fit and the table.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "brdf/albedo.h"
#include "config/config.h"
#include "core/run_context.h"
#include "fit/fit_table.h"
#include "fit/gradient_check.h"
#include "pipeline/post_process.h"

namespace ltc {

// All that is known of one lobe's fit. Matrices are M, but for `finished.stored`. Where the status
// says that there are no values, matrices and losses are NaN.
struct LobeFit {
  Lobe lobe;
  std::vector<WatchedFit> fits;  // the lobe's own fit, then the sweeps
  FittedEntry fitted;            // as the solver left it; `loss` on the solver's own samples
  Creases creases;               // of the fold that `fitted` has; none: it has none
  double kappa = 0;              // of the fold, as fields have it (field/field.h); gamma is its g
  bool start_abandoned = false;  // for the solver's own, see FitResult
  Eigen::Matrix3d aligned;
  PostProcessed finished;
  Eigen::Matrix3d matrix;  // M of what is stored
  Albedo albedo;
  double held_out_loss = 0;  // of `matrix`, by samples that the fit has not seen
  // Of a fold: the LTC of the same settings, which is fitted beside it.
  std::optional<FittedEntry> ltc;
  double ltc_held_out_loss = 0;
  double spread = 0;  // of the lobe, the scale of losses (HeldOutJudge::spread)
};

// The entries that have to be fitted for `flat` to come out as in a table of all `needed` entries,
// bit for bit: its representative and, for every neighbour sweep, the neighbours of what the sweep
// before needs, with the representatives of those. `needed` must contain `flat`.
std::vector<bool> entries_behind(const Grid& grid, const std::vector<bool>& needed,
                                 std::size_t flat, int sweeps);

// Entry `flat` of the table that generate_table(config, needed, …) makes, bit for bit: what is
// stored, loss, steps, status, amplitude and Fresnel. `fits` are those of its representative.
// Throws InputError for an entry that is not needed, else as generate_table. Of folded lobes, whose
// tables start from a field's values, the lobe by itself.
LobeFit fit_table_entry(const Config& config, const std::vector<bool>& needed, std::size_t flat,
                        const RunContext& run);

// A lobe by itself, from `start` (M) or else from the solver's own starting points. A matrix that
// is folded is not aligned: that turns the cosine about its axis, and the creases with it.
LobeFit fit_lobe(const Config& config, const Lobe& lobe, std::uint64_t seed,
                 const std::optional<Eigen::Matrix3d>& start, const RunContext& run = {});

// M of a starting point of the solvers (starting_points.h); `seed` is that of a random one.
Eigen::Matrix3d starting_matrix(StartKind kind, const Lobe& lobe, std::uint64_t seed);

// Checks the gradient that descents follow, at M, on a small sample set of the lobe. Of a folded
// one, that of M: its samples are folded first.
GradientCheck check_lobe_gradient(const Lobe& lobe, const Eigen::Matrix3d& matrix,
                                  const Fold& fold = {}, const Creases& creases = {});

}  // namespace ltc
