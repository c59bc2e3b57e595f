// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "bench/setting.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace ltc {
namespace {

// On samples, fewer or more of them everywhere than the defaults say.
FitSettings gauss_newton(int samples, int directions, int target_samples) {
  FitSettings fit;
  fit.gauss_newton.loss = LossKind::samples;
  fit.gauss_newton.samples = samples;
  fit.gauss_newton.directions = directions;
  fit.gauss_newton.target_samples = target_samples;
  return fit;
}

// By arcs, with so many directions and thresholds.
FitSettings arcs(int directions, int target_samples) {
  FitSettings fit;
  fit.gauss_newton.directions = directions;
  fit.gauss_newton.target_samples = target_samples;
  return fit;
}

FitSettings with_starts(int starts) {
  FitSettings fit;
  fit.gauss_newton.starts = starts;
  return fit;
}

FitSettings with_sweep() {
  FitSettings fit;
  fit.gauss_newton.neighbour_sweeps = 1;
  return fit;
}

FitSettings rejection() {
  FitSettings fit;
  fit.target = TargetKind::rejection;
  return fit;
}

// config/reference.toml, without its sweeps: one costs a hundred fits of neighbours an entry where
// the entries lie apart.
FitSettings reference() {
  FitSettings fit = gauss_newton(8192, 96, 131072);
  fit.gauss_newton.coarse_samples = 1024;
  fit.gauss_newton.coarse_directions = 32;
  fit.gauss_newton.coarse_steps = 40;
  fit.gauss_newton.coarse_tolerance = 1e-3;
  fit.gauss_newton.steps = 60;
  fit.gauss_newton.tolerance = 1e-5;
  fit.gauss_newton.adaptive = false;
  fit.gauss_newton.starts = 6;
  fit.gauss_newton.start_margin = 1e9;
  fit.gauss_newton.neighbour_sweeps = 0;
  return fit;
}

// config/paper.toml.
FitSettings sgd_published() {
  FitSettings fit;
  fit.solver = SolverKind::sgd;
  fit.target = TargetKind::rejection;
  return fit;
}

// config/sgd.toml.
FitSettings sgd_practical() {
  FitSettings fit;
  fit.solver = SolverKind::sgd;
  fit.sgd.steps = 300;
  fit.sgd.samples = 512;
  fit.sgd.directions = 16;
  fit.sgd.step_scale = 5;
  fit.sgd.step_decay = 0.98;
  fit.sgd.averaged_steps = 20;
  fit.sgd.start = StartKind::moments;
  fit.sgd.scaled_variables = true;
  fit.sgd.lattice_samples = true;
  return fit;
}

FitSettings l3(StartKind start) {
  FitSettings fit;
  fit.solver = SolverKind::l3_nelder_mead;
  fit.l3.start = start;
  return fit;
}

std::string names_of(const std::vector<BenchSetting>& settings) {
  std::string names;
  for (const BenchSetting& setting : settings)
    names += (names.empty() ? "" : ", ") + setting.name;
  return names;
}

}  // namespace

std::vector<BenchSetting> bench_settings(std::uint64_t seed) {
  std::vector<BenchSetting> settings = {
      {"gn-256x16", "256 × 16", "256 samples, 16 directions", gauss_newton(256, 16, 1024)},
      {"gn-512x24", "512 × 24", "512 samples, 24 directions", gauss_newton(512, 24, 2048)},
      {"gn-1024x32", "1024 × 32", "1024 samples, 32 directions", gauss_newton(1024, 32, 4096)},
      {"gn-4096x32", "4096 × 32", "up to 4096 samples, 32 directions",
       gauss_newton(4096, 32, 8192)},
      {"gn-4096x64", "4096 × 64", "4096 samples, 64 directions", gauss_newton(4096, 64, 16384)},
      {"arcs-16", "16 × 16 arcs", "by arcs: 16 directions and thresholds", arcs(16, 2048)},
      {"default", "default", "config/default.toml: 32 directions and thresholds by arcs, 1 start",
       FitSettings{}},
      {"arcs-64", "64 × 64 arcs", "by arcs: 64 directions and thresholds", arcs(64, 65536)},
      {"reference", "reference", "config/reference.toml without sweeps", reference()},
      {"default-2-starts", "2 starts", "the default from two starting points", with_starts(2)},
      {"default-3-starts", "3 starts", "the default from three starting points", with_starts(3)},
      {"default-sweep", "sweep", "the default, then trying its neighbours' solutions",
       with_sweep()},
      {"default-rejection", "rejection", "the default with the published target", rejection()},
      {"sgd-practical", "SGD, practical", "config/sgd.toml: scaled descent, 300 steps",
       sgd_practical()},
      {"sgd-published", "SGD, published", "config/paper.toml: 10,000 steps; few are timed",
       sgd_published(), 8},
      {"l3-nelder-mead", "L3, first-order start", "L3 error by simplex from the first-order start",
       l3(StartKind::first_order)},
      {"l3-identity", "L3, identity start", "L3 error by simplex from the clamped cosine",
       l3(StartKind::identity)},
  };
  for (BenchSetting& setting : settings)
    setting.fit.seed = seed;
  return settings;
}

std::vector<BenchSetting> select_settings(const std::vector<BenchSetting>& all,
                                          std::string_view list) {
  if (list.empty())
    return all;
  std::vector<BenchSetting> selected;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string_view name = list.substr(begin, end - begin);
    begin = end + 1;
    const auto is_named = [&](const BenchSetting& setting) { return setting.name == name; };
    const auto found = std::find_if(all.begin(), all.end(), is_named);
    if (found == all.end())
      throw InputError(
          fmt::format("unknown setting \"{}\"; expected a list of {}", name, names_of(all)));
    if (std::any_of(selected.begin(), selected.end(), is_named))
      throw InputError(fmt::format("setting \"{}\" stands twice; expected each once", name));
    selected.push_back(*found);
  }
  return selected;
}

}  // namespace ltc
