// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The hot loops of a step, and the sort that they replace: one projection direction each.
#include <benchmark/benchmark.h>
#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>

#include "core/ordered_float.h"
#include "core/random.h"
#include "fit/kernels.h"
#include "lobe.h"

namespace ltc::bench {
namespace {

// What is done for a direction in the published method alone: the bound that binning goes below.
template <typename Key, typename MakeKey>
void sort_keys(benchmark::State& state, const MakeKey& make_key) {
  const auto count = static_cast<std::size_t>(state.range(0));
  Random random(1);
  AlignedVector<Key> unsorted(count), keys(count);
  for (std::uint32_t i = 0; i < count; ++i)
    unsorted[i] = make_key(static_cast<float>(random.normal()), i);
  hwy::Sorter sorter;
  for (auto _ : state) {
    std::copy(unsorted.begin(), unsorted.end(), keys.begin());
    sorter(keys.data(), count, hwy::SortAscending());
    benchmark::DoNotOptimize(keys.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void sort_values_with_index(benchmark::State& state) {
  sort_keys<std::uint64_t>(state,
                           [](float value, std::uint32_t index) { return sort_key(value, index); });
}
BENCHMARK(sort_values_with_index)->Arg(256)->Arg(1024)->Arg(2048)->Arg(4096);

void sort_values_alone(benchmark::State& state) {
  sort_keys<float>(state, [](float value, std::uint32_t) { return value; });
}
BENCHMARK(sort_values_alone)->Arg(1024)->Arg(2048)->Arg(4096);

// Everything that a direction's loops read and write, filled by the loops before it.
struct Buffers {
  explicit Buffers(std::size_t samples) : sets(samples, 32, 4096) {
    for (AlignedFloats* array : {&gx, &gy, &gz})
      array->resize(samples);
    rows.resize(samples * kernels::row_width);
    xi.resize(kernels::directions_at_once * samples);
    bins.resize(kernels::directions_at_once * samples);
    sums.resize(kernels::directions_at_once * sets.bins * kernels::row_width);
    populations.resize(kernels::directions_at_once * sets.bins);
    for (int i = 0; i < 9; ++i)
      p[i] = static_cast<float>(sets.start(i / 3, i % 3));
    transform();
    for (std::size_t k = 0; k < kernels::directions_at_once; ++k) {
      direction_z[k] = sets.quantiles.map(5 + k).direction_z;
      project(k);
    }
  }
  void transform() {
    kernels::transform_samples(
        {p, static_cast<float>(lobe.alpha_x), static_cast<float>(lobe.alpha_y)},
        {sets.cosines.x.data(), sets.cosines.y.data(), sets.cosines.z.data(), gx.size()},
        {gx.data(), gy.data(), gz.data(), rows.data()});
  }
  void project(std::size_t k) {
    kernels::project_and_bin(sets.quantiles.map(5 + k),
                             {gx.data(), gy.data(), gz.data(), gx.size()}, sets.bins,
                             xi.data() + k * gx.size(), bins.data() + k * gx.size());
  }
  void project_one() { project(0); }
  void accumulate() {
    std::fill(sums.begin(), sums.end(), 0.0f);
    std::fill(populations.begin(), populations.end(), 0);
    kernels::accumulate_rows({xi.data(), bins.data(), gx.size(), sets.bins}, rows.data(),
                             direction_z, kernels::directions_at_once,
                             {sums.data(), populations.data()});
  }

  Sets sets;
  float direction_z[kernels::directions_at_once];
  float p[9];
  AlignedFloats gx, gy, gz, xi, rows, sums;
  AlignedVector<std::int32_t> bins, populations;
};

void run(benchmark::State& state, void (Buffers::*loop)()) {
  Buffers buffers(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    (buffers.*loop)();
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

// Once a step, for all directions.
void transform_samples(benchmark::State& state) {
  run(state, &Buffers::transform);
}
BENCHMARK(transform_samples)->Arg(256)->Arg(1024)->Arg(2048);

void project_and_bin(benchmark::State& state) {
  run(state, &Buffers::project_one);
}
BENCHMARK(project_and_bin)->Arg(256)->Arg(1024)->Arg(2048);

// Four directions at once: an item is a sample along one of them.
void accumulate_rows(benchmark::State& state) {
  run(state, &Buffers::accumulate);
  state.SetItemsProcessed(state.iterations() * state.range(0) *
                          static_cast<std::int64_t>(kernels::directions_at_once));
}
BENCHMARK(accumulate_rows)->Arg(256)->Arg(1024)->Arg(2048);

// Once a lobe and direction.
void accumulate_weights(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const Sets sets(2048, 32, count);
  AlignedFloats xi(count), pairs(2 * count), sums(2 * sets.bins);
  AlignedVector<std::int32_t> bins(count);
  kernels::project_and_bin(
      sets.quantiles.map(5),
      {sets.target.gx.data(), sets.target.gy.data(), sets.target.gz.data(), count}, sets.bins,
      xi.data(), bins.data());
  for (auto _ : state) {
    std::fill(sums.begin(), sums.end(), 0.0f);
    kernels::accumulate_weights(xi.data(), bins.data(), sets.target.weight.data(), count,
                                pairs.data(), sums.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(accumulate_weights)->Arg(4096);

}  // namespace
}  // namespace ltc::bench
