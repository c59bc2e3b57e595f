// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Counts what went wrong in a stress run, and says whether that is too much.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "stress/run.h"

namespace ltc {

// A fit has missed its lobe when its loss is above this many times the best known.
inline constexpr double largest_good_ratio = 1.05;
// The share of fits from bad starts that must not miss.
inline constexpr double least_success_from_bad_starts = 0.999;

struct StressCounts {
  std::size_t fits = 0;
  std::size_t non_finite = 0;
  std::size_t determinants_not_positive = 0;  // of the finite
  std::size_t missed = 0;                     // of those with a determinant > 0
  std::size_t abandoned = 0;                  // ended from another start than they were given
  double largest_ratio = 0;                   // of the finite with a determinant > 0
  double mean_steps = 0, mean_seconds = 0;
  int most_steps = 0;
  double most_seconds = 0;

  std::size_t failures() const { return non_finite + determinants_not_positive + missed; }
  double success_rate() const {
    return fits == 0 ? 0 : 1 - static_cast<double>(failures()) / static_cast<double>(fits);
  }
};

bool succeeded(const StressFit& fit);

// Over those of the fits that `chosen` (StressFit -> bool) takes.
template <typename Chosen>
StressCounts count(const std::vector<StressFit>& fits, Chosen&& chosen);

void add_to(StressCounts& counts, const StressFit& fit);
void finish(StressCounts& counts);

template <typename Chosen>
StressCounts count(const std::vector<StressFit>& fits, Chosen&& chosen) {
  StressCounts counts;
  for (const StressFit& fit : fits)
    if (chosen(fit))
      add_to(counts, fit);
  finish(counts);
  return counts;
}

struct StressVerdict {
  StressCounts own, bad;                 // from the program's own starts, and from all others
  std::vector<StressCounts> by_start;    // in the order of stress_starts()
  std::vector<std::size_t> worst;        // indices into the fits: failures, the worst first
  std::vector<std::string> missed_bars;  // one line each; empty if all is as it must be
};

// At most `most_worst` fits are named, no lobe twice.
StressVerdict judge_stress(const std::vector<StressFit>& fits, std::size_t most_worst);

}  // namespace ltc
