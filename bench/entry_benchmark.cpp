// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a table's entry consists of: target, steps, the whole fit, alignment, albedo.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "align/align.h"
#include "brdf/albedo.h"
#include "fit/solver.h"
#include "lobe.h"

namespace ltc::bench {
namespace {

// Arguments: samples, directions.
void evaluate_model(benchmark::State& state) {
  Sets sets(static_cast<std::size_t>(state.range(0)), static_cast<std::size_t>(state.range(1)),
            4096);
  ModelValue value;
  for (auto _ : state) {
    ltc::evaluate_model(
        {sets.frame, sets.start, sets.cosines, sets.quantiles, 1, 1e-2 * sets.quantiles.spread()},
        sets.model, value);
    benchmark::DoNotOptimize(value.loss);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(1));
}
BENCHMARK(evaluate_model)->Args({256, 16})->Args({1024, 32})->Args({2048, 32})->Args({4096, 64});

// Argument: target samples.
void sample_target(benchmark::State& state) {
  Sets sets(2048, 32, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    sample_weighted_target(sets.frame, sets.lattice, sets.target);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(sample_target)->Arg(4096)->Arg(16384);

// Arguments: target samples, directions.
void build_target(benchmark::State& state) {
  Sets sets(2048, static_cast<std::size_t>(state.range(1)),
            static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    sets.quantiles.build(sets.target, sets.directions, sets.bins, sets.model.xi, sets.model.bins);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(1));
}
BENCHMARK(build_target)->Args({4096, 16})->Args({4096, 32});

void fit_with(benchmark::State& state, const FitSettings& settings) {
  const std::unique_ptr<Solver> solver = make_solver(settings);
  const FitWorkspacePointer workspace = make_fit_workspace();
  FitRequest request;
  request.lobe = lobe;
  request.seed = 1;
  int steps = 0;
  for (auto _ : state)
    steps = solver->fit(request, *workspace, nullptr).steps;
  state.counters["steps"] = steps;
}

void fit_by_default(benchmark::State& state) {
  fit_with(state, {});
}
BENCHMARK(fit_by_default)->Unit(benchmark::kMicrosecond);

void fit_again_from_incumbent(benchmark::State& state) {
  const std::unique_ptr<Solver> solver = make_solver({});
  const FitWorkspacePointer workspace = make_fit_workspace();
  FitRequest request;
  request.lobe = lobe;
  request.incumbent = solver->fit(request, *workspace, nullptr);
  request.starts.assign(8, request.incumbent->matrix);
  for (auto _ : state)
    benchmark::DoNotOptimize(solver->fit(request, *workspace, nullptr).loss);
}
BENCHMARK(fit_again_from_incumbent)->Unit(benchmark::kMicrosecond);

// Argument: steps of the published descent; the difference of two is the time of steps alone.
void descend_as_published(benchmark::State& state) {
  FitSettings settings;
  settings.solver = SolverKind::sgd;
  settings.target = TargetKind::rejection;
  settings.sgd.steps = static_cast<int>(state.range(0));
  fit_with(state, settings);
}
BENCHMARK(descend_as_published)->Arg(1)->Arg(5)->Unit(benchmark::kMicrosecond);

void align_matrix(benchmark::State& state) {
  const LobeFrame frame(lobe);
  const Eigen::Matrix3d matrix = frame.to_matrix(first_order_start(frame));
  for (auto _ : state)
    benchmark::DoNotOptimize(align(matrix).sum());
}
BENCHMARK(align_matrix);

void integrate_albedo(benchmark::State& state) {
  const AlbedoRule rule;
  for (auto _ : state)
    benchmark::DoNotOptimize(ltc::integrate_albedo(lobe, rule).amplitude);
}
BENCHMARK(integrate_albedo);

}  // namespace
}  // namespace ltc::bench
