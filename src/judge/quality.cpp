// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "fit/fit_table.h"
#include "fit/solver.h"
#include "judge/quality_summary.h"
#include "ltc/folded.h"
#include "table/field_table.h"
#include "table/query_range.h"

namespace ltc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void check(const QualitySettings& settings) {
  const auto require = [](const char* what, std::size_t value, std::size_t least) {
    if (value < least)
      throw InputError(fmt::format("quality by {} {}; expected at least {}", value, what, least));
  };
  require("node samples", settings.node_samples, 16);
  require("node directions", settings.node_directions, 1);
  require("query samples", settings.query_samples, 16);
  require("query directions", settings.query_directions, 1);
  if (const FitSettings& floor = settings.floor_fit;
      floor.second_crease > 0 && floor.second_crease <= floor.crease)
    throw InputError(
        fmt::format("quality.floor_second_crease = {} is not above quality.floor_crease = {}; "
                    "expected more, or 0",
                    floor.second_crease, floor.crease));
  const QueryRange& range = settings.range;
  if (range.roughness_first > range.roughness_last)
    throw InputError(fmt::format("queries of roughness from {} to {}; expected a rising range",
                                 range.roughness_first, range.roughness_last));
}

HeldOutJudge node_judge(const QualitySettings& settings, std::size_t flat) {
  return HeldOutJudge(settings.node_samples, settings.node_directions, settings.seed + flat,
                      settings.horizon);
}

// By judge_pair, which holds one direction at a time: what set_lobe would keep of all of them is
// megabytes, and asking the system for them anew for every lobe takes as long as the judging.
double relative_loss(HeldOutJudge judge, const Lobe& lobe, const LtcLobe& ltc) {
  const PairJudgement judgement = judge.judge_pair(lobe, ltc, ltc);
  return judgement.loss_a / judgement.spread;
}

QueryQuality left_out(QueryState state) {
  const AreaLightError none{nan, nan, nan};
  return {state, nan, none, none, nan};
}

QueryQuality judge_query(const Table& table, const QualitySettings& settings,
                         const QueryFloor& floor, std::size_t query, AreaLightJudge& area_light) {
  const auto [state, found] = ask(table, floor.lobe);
  if (state != QueryState::judged)
    return left_out(state);
  area_light.set_lobe(floor.lobe, query);
  return {QueryState::judged, relative_loss(query_judge(settings, query), floor.lobe, found.ltc()),
          area_light.error(found.ltc()), area_light.error(found.ltc(), found.amplitude),
          share_below_horizon(found.ltc())};
}

Statistics nodes_below_horizon(const Table& table) {
  std::vector<double> shares(table.grid.size(), nan);
  for (std::size_t flat = 0; flat < shares.size(); ++flat)
    if (has_values(table.status[flat]))
      shares[flat] = share_below_horizon(table.ltc_at(flat));
  return statistics_of(shares);
}

// Which nodes are judged: all, or at most so many, drawn without replacement.
std::vector<std::size_t> nodes_to_judge(const Table& table, std::size_t most, std::uint64_t seed) {
  std::vector<std::size_t> nodes;
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat)
    if (has_values(table.status[flat]))
      nodes.push_back(flat);
  if (nodes.size() <= most)
    return nodes;
  Random random(seed);
  for (std::size_t i = 0; i < most; ++i) {
    const auto left = static_cast<double>(nodes.size() - i);
    std::swap(nodes[i], nodes[i + static_cast<std::size_t>(random.uniform() * left)]);
  }
  nodes.resize(most);
  return nodes;
}

std::vector<double> judge_nodes(const Table& table, const QualitySettings& settings,
                                const RunContext& run) {
  std::vector<double> losses(table.grid.size(), nan);
  const std::vector<std::size_t> nodes = nodes_to_judge(table, settings.most_nodes, settings.seed);
  parallel_for_each("judge nodes", nodes.size(), run, [&](std::size_t i) {
    const std::size_t flat = nodes[i];
    losses[flat] =
        relative_loss(node_judge(settings, flat), table.grid.lobe(flat), table.ltc_at(flat));
  });
  return losses;
}

std::vector<double> judge_node_fits(const Table& table, const QualitySettings& settings,
                                    const RunContext& run) {
  if (is_folded(table) || settings.fitted_nodes == 0)
    return {};
  // Not those of judge_nodes alone.
  const std::vector<std::size_t> nodes =
      nodes_to_judge(table, settings.fitted_nodes, settings.seed + 1);
  FitSettings fit;
  fit.horizon = settings.horizon;
  const std::unique_ptr<Solver> solver = make_solver(fit);
  std::vector<double> ratios(nodes.size(), nan);
  parallel_for_each<FitWorkspacePointer>(
      "fit nodes", nodes.size(), run, make_fit_workspace,
      [&](std::size_t i, FitWorkspacePointer& workspace) {
        FitRequest request;
        request.lobe = table.grid.lobe(nodes[i]);
        request.seed = entry_seed(fit.seed, nodes[i]);
        request.progress = run.progress;
        const LtcLobe own(solver->fit(request, *workspace, nullptr).matrix);
        const PairJudgement judgement =
            node_judge(settings, nodes[i]).judge_pair(request.lobe, table.ltc_at(nodes[i]), own);
        ratios[i] = judgement.loss_a / judgement.loss_b;
      });
  return ratios;
}

std::vector<QueryQuality> judge_queries(const Table& table, const QualitySettings& settings,
                                        const std::vector<QueryFloor>& floors,
                                        const RunContext& run) {
  std::vector<QueryQuality> queries(floors.size());
  const AreaLightJudge prototype = area_light_judge(settings);
  parallel_for_each<AreaLightJudge>(
      "judge queries", queries.size(), run, [&] { return prototype; },
      [&](std::size_t i, AreaLightJudge& area_light) {
        queries[i] = judge_query(table, settings, floors[i], i, area_light);
      });
  return queries;
}

}  // namespace

HeldOutJudge query_judge(const QualitySettings& settings, std::size_t query) {
  return HeldOutJudge(settings.query_samples, settings.query_directions, settings.seed + query,
                      settings.horizon);
}

AreaLightJudge area_light_judge(const QualitySettings& settings) {
  return AreaLightJudge({settings.quads, settings.quad_samples, settings.seed, settings.horizon});
}

Answer ask(const Table& table, const Lobe& lobe) {
  const LookUp found = look_up(table, lobe);
  const QueryState state = !Reduction(table.grid).covers(lobe) ? QueryState::outside
                           : !found.matrix.allFinite()         ? QueryState::missing
                                                               : QueryState::judged;
  return {state, found};
}

FitSettings floor_fit_settings() {
  FitSettings settings;
  settings.gauss_newton.starts = 3;
  settings.gauss_newton.start_margin = 1e9;
  settings.gauss_newton.adaptive = false;
  return settings;
}

std::vector<QueryFloor> fit_queries(const QualitySettings& settings, const Grid& grid,
                                    const RunContext& run) {
  check(settings);
  const std::vector<Lobe> lobes =
      random_queries(settings.range, settings.queries, settings.seed, grid.alpha_min, *grid.model);
  std::vector<QueryFloor> floors(lobes.size());
  FitSettings floor_fit = settings.floor_fit;
  floor_fit.horizon = settings.horizon;
  const std::unique_ptr<Solver> solver = make_solver(floor_fit);
  const Creases creases = settings.floor_fit.creases();
  struct State {
    FitWorkspacePointer workspace;
    AreaLightJudge area_light;
  };
  const AreaLightJudge prototype = area_light_judge(settings);
  parallel_for_each<State>(
      "fit queries", lobes.size(), run,
      [&] {
        return State{make_fit_workspace(), prototype};
      },
      [&](std::size_t i, State& state) {
        FitRequest request;
        request.lobe = lobes[i];
        request.seed = entry_seed(settings.floor_fit.seed, i);
        request.progress = run.progress;
        state.area_light.set_lobe(lobes[i], i);
        QueryFloor& floor = floors[i];
        floor.lobe = lobes[i];
        const FitResult fit = solver->fit(request, *state.workspace, nullptr);
        floor.matrix = fit.matrix;
        floor.fold = fit.fold;
        const LtcLobe ltc(fit.matrix, fit.fold, creases);
        floor.relative_loss = relative_loss(query_judge(settings, i), lobes[i], ltc);
        floor.area_light = state.area_light.error(ltc);
      });
  return floors;
}

QualityReport measure_quality(const Table& table, const QualitySettings& settings,
                              std::vector<QueryFloor> floors, const RunContext& run) {
  check(settings);
  QualityReport report;
  report.settings = settings;
  report.floors = std::move(floors);
  report.node_losses = judge_nodes(table, settings, run);
  report.node_fit_ratios = judge_node_fits(table, settings, run);
  report.nodes_without_values = static_cast<std::size_t>(std::count_if(
      table.status.begin(), table.status.end(), [](Status s) { return !has_values(s); }));
  report.queries = judge_queries(table, settings, report.floors, run);
  report.nodes_below_horizon = nodes_below_horizon(table);
  summarize_quality(report);
  return report;
}

QualityReport measure_quality(const Table& table, const QualitySettings& settings,
                              const RunContext& run) {
  check(settings);
  QualitySettings served = settings;
  served.range = query_range_of(table.grid, settings.range);
  return measure_quality(table, served, fit_queries(served, table.grid, run), run);
}

}  // namespace ltc
