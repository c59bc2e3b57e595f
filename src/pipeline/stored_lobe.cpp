// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/stored_lobe.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "fit/solver.h"
#include "judge/held_out.h"
#include "judge/quality.h"
#include "table/entry_text.h"
#include "table/lookup.h"

namespace ltc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void require_values(const Table& table, std::size_t flat) {
  if (has_values(table.status[flat]))
    return;
  throw InputError(fmt::format(
      "entry {} ({}) has no values: {}", entry_text(table.grid, flat), lobe_text(table.grid, flat),
      table.status[flat] == Status::failed ? "its fit failed"
                                           : "the scene of the table did not need it"));
}

// Everything that follows from the lobe and the table's matrix.
void judge(const Table& table, const RunContext& run, StoredLobe& stored) {
  Config config;
  config.grid.alpha_min = table.grid.alpha_min;
  config.storage = table.storage;
  config.fit = floor_fit_settings();
  stored.floor = fit_lobe(config, stored.lobe, entry_seed(config.fit.seed, 0), std::nullopt, run);
  HeldOutJudge judge;
  judge.set_lobe(stored.lobe);
  stored.held_out_loss = judge.loss(stored.ltc());
}

double relative_loss_of_node(const Table& table, std::size_t flat, const RunContext& run) {
  run.throw_if_stopped();
  HeldOutJudge judge;
  judge.set_lobe(table.grid.lobe(flat));
  return judge.loss(table.ltc_at(flat)) / judge.spread();
}

}  // namespace

StoredLobe stored_entry(const Table& table, std::size_t flat, const RunContext& run) {
  require_values(table, flat);
  StoredLobe stored;
  stored.lobe = table.grid.lobe(flat);
  stored.entry = flat;
  stored.stored = table.stored_at(flat);
  stored.matrix = table.matrix_at(flat);
  stored.fold = table.fold_at(flat);
  stored.creases = table.creases;
  stored.albedo = {table.amplitude[flat], table.fresnel[flat]};
  stored.stated_loss = table.sw_loss[flat];
  judge(table, run, stored);
  return stored;
}

StoredLobe stored_query(const Table& table, const Lobe& lobe, const RunContext& run) {
  const Reduction reduction(table.grid);
  const Interpolation taken = interpolation(table.grid, reduction.fold(lobe).lobe);
  StoredLobe stored;
  stored.lobe = lobe;
  stored.within_axes = reduction.covers(lobe);
  for (std::size_t i = 0; i < taken.nodes.size() && !table.field; ++i)
    if (taken.weights[i] != 0)
      stored.nodes.push_back({taken.nodes[i], taken.weights[i], 0});
  std::stable_sort(stored.nodes.begin(), stored.nodes.end(),
                   [](const TakenNode& a, const TakenNode& b) { return a.weight > b.weight; });
  for (TakenNode& node : stored.nodes) {
    require_values(table, node.flat);
    node.relative_loss = relative_loss_of_node(table, node.flat, run);
  }
  const LookUp found = look_up(table, lobe);
  stored.stored = Eigen::Matrix3d::Constant(nan);
  stored.matrix = found.matrix;
  stored.fold = found.fold;
  stored.creases = found.creases;
  stored.albedo = {found.amplitude, found.fresnel};
  stored.stated_loss = nan;
  judge(table, run, stored);
  return stored;
}

}  // namespace ltc
