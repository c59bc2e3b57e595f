// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/sample_ladder.h"

#include <algorithm>
#include <utility>

namespace ltc {
namespace {

// A lobe whose loss is r of its spread is fitted with at least this over r samples: the share that
// the lattice's noise has in the loss is then below some 1 %.
constexpr double samples_per_inverse_loss = 30;

// Of the graded sets. More than the largest number does not pay.
constexpr int least_graded_samples = 512, most_graded_samples = 4096;

// Ten times as much is as large as what an LTC misses of a sharp lobe, and held fits at twice the
// least loss; without any, some end at a sixth above it.
constexpr double graded_prior_weight = 1e-3;

// First damping of all levels but the coarse one: they start next to a minimum.
constexpr double damping_near_minimum = 1e-3;

SampleLevel make_coarse(CosineSet cosines, const GaussNewtonSettings& settings) {
  SampleLevel level{std::move(cosines), {}, {}};
  level.options.steps = settings.coarse_steps;
  level.options.tolerance = settings.coarse_tolerance;
  level.options.direction_stride =
      static_cast<std::size_t>(std::max(1, settings.directions / settings.coarse_directions));
  return level;
}

SampleLevel make_fine(CosineSet cosines, const GaussNewtonSettings& settings) {
  SampleLevel level{std::move(cosines), {}, {}};
  level.options.steps = settings.steps;
  level.options.tolerance = settings.tolerance;
  level.options.damping = damping_near_minimum;
  return level;
}

void set_lobe(SampleLadder& ladder, const Creases& creases, HorizonMode horizon) {
  const auto set = [&](SampleLevel& level) {
    level.cosines.horizon = horizon;
    if (!creases.empty())
      level.u = crease_distances(level.cosines, creases);
  };
  set(ladder.coarse);
  std::ranges::for_each(ladder.levels, set);
}

}  // namespace

SampleLadder make_ladder(const GaussNewtonSettings& settings, const Creases& creases,
                         HorizonMode horizon) {
  const auto target_samples = static_cast<std::size_t>(settings.target_samples);
  SampleLadder ladder;
  ladder.lattice = make_target_lattice(target_samples, 0.3);
  ladder.light_lattice =
      settings.adaptive ? make_target_lattice(std::max(target_samples / 2, std::size_t{64}), 0.3)
                        : ladder.lattice;
  ladder.coarse = make_coarse(
      make_cosine_set(static_cast<std::size_t>(settings.coarse_samples), 0.1), settings);
  for (const int divisor : {4, 2, 1}) {
    const int samples = settings.samples / divisor;
    if (divisor > 1 && (!settings.adaptive || samples < settings.coarse_samples))
      continue;
    ladder.levels.push_back(
        make_fine(make_cosine_set(static_cast<std::size_t>(samples)), settings));
  }
  set_lobe(ladder, creases, horizon);
  return ladder;
}

SampleLadder make_graded_ladder(const GaussNewtonSettings& settings, const Creases& creases,
                                HorizonMode horizon) {
  const auto coarse =
      static_cast<std::size_t>(std::max(settings.coarse_samples, least_graded_samples));
  const auto fine = static_cast<std::size_t>(
      std::clamp(settings.samples, least_graded_samples, most_graded_samples));
  SampleLadder ladder;
  ladder.spacing = BinSpacing::graded;
  ladder.graded_light_lattice = make_graded_lattice(coarse);
  ladder.graded_lattice = make_graded_lattice(fine);
  ladder.coarse = make_coarse(make_graded_cosine_set(coarse), settings);
  ladder.levels.push_back(make_fine(make_graded_cosine_set(fine), settings));
  for (SampleLevel* level : {&ladder.coarse, &ladder.levels.back()})
    level->options.prior_weight = graded_prior_weight;
  set_lobe(ladder, creases, horizon);
  return ladder;
}

std::size_t level_for(const SampleLadder& ladder, double relative_loss) {
  std::size_t level = 0;
  while (level + 1 < ladder.levels.size() &&
         static_cast<double>(ladder.levels[level].cosines.size()) * relative_loss <
             samples_per_inverse_loss)
    ++level;
  return level;
}

std::size_t bins_for(int samples) {
  return static_cast<std::size_t>(std::clamp(samples / 64 / 16 * 16, 32, 256));
}

}  // namespace ltc
