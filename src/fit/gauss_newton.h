// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Levenberg-Marquardt on the quantile model: one start, one sample set, a fixed number of steps.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <vector>

#include "fit/arc_model.h"
#include "fit/quantile_model.h"
#include "fit/solver.h"

namespace ltc {

struct DescentOptions {
  int steps = 10;           // most steps, accepted or not
  double tolerance = 1e-3;  // stop when an accepted step gains less than this share of the loss
  double damping = 1e-2;    // first damping, relative to the curvature's diagonal
  double least_damping = 1e-5;
  double prior_weight = 1e-2;        // of the pull towards P0, see prior()
  std::size_t direction_stride = 1;  // every which of the target's directions is looked along
  // What a trace calls these steps, and since when it counts time.
  FitPhase phase = {};
  std::chrono::steady_clock::time_point begin = {};
  const Progress* progress = nullptr;  // where not null, a stop asked for ends it early
};

struct Descent {
  Eigen::Matrix3d frame_matrix;  // P, third column of unit length
  Bend bend = Bend::Zero();      // of a folded lobe
  double loss = 0;               // of the model's samples, without the prior
  int steps = 0;
  bool converged = false;
};

// What the descent adds to the loss at P, for a target of this spread: a weak pull of columns 0 and
// 1 towards the first-order P0 that decides what the samples of a sharp lobe leave open. `weight`
// is DescentOptions::prior_weight.
// A fold is pulled to none likewise, by what it moves the lobe beside its width.
double prior(const LobeFrame& frame, double spread, const Eigen::Matrix3d& p, double weight,
             const Bend& bend = Bend::Zero());

// The fold to start from, which of its two numbers are free, the largest g, and u of every sample.
struct FoldTask {
  Bend start;
  std::array<bool, 2> free;
  double most_g;
  const AlignedFloats& u;
};

// What an LTC is compared with by arcs.
struct ArcTask {
  ArcView view;
  ArcWorkspace& workspace;
};

// From where, over which entries, to fit which samples to which target, or an LTC by arcs.
struct DescentTask {
  DescentTask(const LobeFrame& frame, const Eigen::Matrix3d& start, const FreeEntries& free,
              const CosineSet& cosines, const TargetQuantiles& target,
              const FoldTask* fold = nullptr)
      : frame(frame), start(start), free(free), cosines(&cosines), target(&target), fold(fold) {}
  DescentTask(const LobeFrame& frame, const Eigen::Matrix3d& start, const FreeEntries& free,
              const ArcTask& arcs)
      : frame(frame), start(start), free(free), arcs(&arcs) {}

  double spread() const { return arcs ? arcs->view.target.spread : target->spread(); }

  const LobeFrame& frame;
  const Eigen::Matrix3d& start;
  const FreeEntries& free;
  const CosineSet* cosines = nullptr;  // null: by arcs
  const TargetQuantiles* target = nullptr;
  const FoldTask* fold = nullptr;  // null: the lobe is not folded
  const ArcTask* arcs = nullptr;   // null: by samples
};

// Minimises the model over the free entries of P, and of the fold, from the start. A weak prior
// (design: sharp lobes) holds columns 0 and 1 near the first-order P0 where the samples say
// nothing. Steps that lose, turn the determinant or are not finite are not taken. `trace` may be
// null.
Descent minimise(const DescentTask& task, const DescentOptions& options, ModelWorkspace& workspace,
                 std::vector<FitStep>* trace);

}  // namespace ltc
