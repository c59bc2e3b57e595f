// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "stress/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace ltc {
namespace {

// How bad a fit is: what is not finite is worse than a determinant that is not positive, that than
// any loss.
double badness(const StressFit& fit) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!fit.finite())
    return infinity;
  return fit.determinant_positive() ? fit.ratio : std::numeric_limits<double>::max();
}

std::vector<std::size_t> worst_fits(const std::vector<StressFit>& fits, std::size_t most) {
  std::vector<std::size_t> order(fits.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return badness(fits[a]) > badness(fits[b]);
  });
  std::vector<std::size_t> worst;
  std::set<std::size_t> lobes;
  for (const std::size_t i : order)
    if (worst.size() < most && lobes.insert(fits[i].lobe).second)
      worst.push_back(i);
  return worst;
}

bool is_own(const StressFit& fit) {
  return stress_starts()[fit.start].own;
}

void require_none(std::size_t count, std::size_t fits, const char* starts, const char* what,
                  std::vector<std::string>& missed) {
  if (count > 0)
    missed.push_back(fmt::format("{} of {} fits from {} starts {}", count, fits, starts, what));
}

std::vector<std::string> missed_bars(const StressCounts& own, const StressCounts& bad) {
  std::vector<std::string> missed;
  if (own.fits == 0 || bad.fits == 0)
    missed.push_back("there were no fits to judge");
  require_none(own.non_finite, own.fits, "own", "are not finite", missed);
  require_none(bad.non_finite, bad.fits, "bad", "are not finite", missed);
  require_none(own.determinants_not_positive, own.fits, "own", "have a determinant <= 0", missed);
  require_none(bad.determinants_not_positive, bad.fits, "bad", "have a determinant <= 0", missed);
  require_none(own.missed, own.fits, "own", "are above 1.05 times the best", missed);
  if (bad.fits > 0 && bad.success_rate() < least_success_from_bad_starts)
    missed.push_back(fmt::format("{:.3f} % of {} fits from bad starts succeed, less than {} %",
                                 100 * bad.success_rate(), bad.fits,
                                 100 * least_success_from_bad_starts));
  return missed;
}

}  // namespace

bool succeeded(const StressFit& fit) {
  return fit.finite() && fit.determinant_positive() && fit.ratio <= largest_good_ratio;
}

void add_to(StressCounts& counts, const StressFit& fit) {
  ++counts.fits;
  counts.abandoned += fit.start_abandoned;
  counts.mean_steps += fit.steps;
  counts.mean_seconds += fit.seconds;
  counts.most_steps = std::max(counts.most_steps, fit.steps);
  counts.most_seconds = std::max(counts.most_seconds, fit.seconds);
  if (!fit.finite()) {
    ++counts.non_finite;
  } else if (!fit.determinant_positive()) {
    ++counts.determinants_not_positive;
  } else {
    counts.missed += !succeeded(fit);
    counts.largest_ratio = std::max(counts.largest_ratio, fit.ratio);
  }
}

void finish(StressCounts& counts) {
  const auto fits = static_cast<double>(std::max<std::size_t>(counts.fits, 1));
  counts.mean_steps /= fits;
  counts.mean_seconds /= fits;
}

StressVerdict judge_stress(const std::vector<StressFit>& fits, std::size_t most_worst) {
  StressVerdict verdict;
  verdict.own = count(fits, is_own);
  verdict.bad = count(fits, [](const StressFit& fit) { return !is_own(fit); });
  for (std::size_t start = 0; start < stress_starts().size(); ++start)
    verdict.by_start.push_back(
        count(fits, [&](const StressFit& fit) { return fit.start == start; }));
  verdict.worst = worst_fits(fits, most_worst);
  verdict.missed_bars = missed_bars(verdict.own, verdict.bad);
  return verdict;
}

}  // namespace ltc
