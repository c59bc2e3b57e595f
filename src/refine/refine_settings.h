// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the config's [refine] section says.
#pragma once

#include "core/enum_names.h"
#include "fit/loss_kind.h"
#include "ltc/horizon.h"
#include "table/queries.h"

namespace ltc {

// What a refinement begins with: matrices in closed form (fit/start_table.h), or each node's fit.
enum class RefineStart { closed_form, fits };
constexpr EnumNames<RefineStart, 2> enum_names(RefineStart) {
  return {"start", {{{RefineStart::closed_form, "closed-form"}, {RefineStart::fits, "fits"}}}};
}

// How a query's loss is measured while a table is refined. Few directions and samples do: what is
// noise in one query is not in its neighbours, which are measured with other sets.
struct QuerySampling {
  LossKind loss = LossKind::arcs;
  int directions = 8;  // projection directions, [4, 4096]
  int thresholds = 8;  // of arcs, where along a direction distributions are compared, [4, 256]
  int samples = 512;   // of samples, those of the cosine, [64, 65536]
  int target_samples = 1024;  // weighted GGX samples, [64, 1048576]
  // As FitSettings::horizon, which sets it.
  HorizonMode horizon = HorizonMode::clipped;
};

struct RefineSettings {
  int steps = 12;  // most outer steps, [0, 1000]; 0 for no refinement
  RefineStart start = RefineStart::closed_form;
  int queries_per_cell = 8;     // refined on, on average, [1, 1000]
  double table_share = 0.1;     // of them uniform in the table's own axes, not as asked for, [0, 1]
  double node_weight = 0.05;    // share of the objective that the nodes' own lobes have, [0, 1]
  int held_out_queries = 2000;  // not refined on: they decide what is kept, [100, 1000000]
  double damping = 0.05;        // first mu, (0, 1e6]
  double overshoot = 1.5;   // steps are taken this many times as long as the model says, (0, 1.9]
  double tolerance = 5e-3;  // ends when a step gains less than this share of the loss, [0, 1]
  bool keep_smoothest = false;  // nodes with alpha <= alpha_min stay as they are
  QuerySampling sampling;
  QueryRange range;  // what is asked for where no scene says so
};

}  // namespace ltc
