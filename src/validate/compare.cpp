// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "validate/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "validate/held_out.h"

namespace ltc {
namespace {

// The least value that at least `share` of the sorted values do not exceed.
double quantile(const std::vector<double>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::min(rank == 0 ? 0 : rank - 1, sorted.size() - 1)];
}

}  // namespace

void require_same_grid(const Grid& a, const Grid& b) {
  if (a == b)
    return;
  const auto shape = [](const Grid& grid) {
    const auto s = grid.shape();
    return fmt::format("{}x{}x{}x{}", s[0], s[1], s[2], s[3]);
  };
  if (a.shape() != b.shape())
    throw InputError(
        fmt::format("the tables have different shapes: {} and {}; entries can only be "
                    "compared on the same grid",
                    shape(a), shape(b)));
  throw InputError(
      "the tables have different axes or another alpha_min; entries can only be "
      "compared on the same grid");
}

std::vector<EntryComparison> compare_tables(const Table& a, const Table& b,
                                            const CompareSettings& settings, int threads,
                                            Progress* progress) {
  require_same_grid(a.grid, b.grid);
  std::vector<EntryComparison> entries(a.grid.size());
  const HeldOutJudge prototype(settings.samples, settings.directions, settings.seed);
  parallel_for_each<HeldOutJudge>(
      "compare", entries.size(), threads, progress, [&] { return prototype; },
      [&](std::size_t flat, HeldOutJudge& judge) {
        const PairJudgement judgement = judge.judge_pair(
            a.grid.lobe(a.grid.node(flat)), a.matrix_at(flat), b.matrix_at(flat));
        entries[flat] = {judgement.loss_a, judgement.loss_b, judgement.spread};
      });
  return entries;
}

RatioSummary summarize_ratios(const std::vector<EntryComparison>& entries,
                              const std::vector<bool>& include) {
  RatioSummary summary;
  std::vector<double> ratios;
  for (std::size_t flat = 0; flat < entries.size(); ++flat) {
    const double ratio = entries[flat].loss_a / entries[flat].loss_b;
    if (!std::isfinite(ratio) || !(include.empty() || include[flat]))
      continue;
    if (ratios.empty() || ratio > summary.largest) {
      summary.largest = ratio;
      summary.largest_entry = flat;
    }
    ratios.push_back(ratio);
    summary.mean_loss_a += entries[flat].loss_a;
    summary.mean_loss_b += entries[flat].loss_b;
  }
  summary.entries = ratios.size();
  if (ratios.empty())
    return summary;
  const auto count = static_cast<double>(ratios.size());
  summary.mean = std::accumulate(ratios.begin(), ratios.end(), 0.0) / count;
  summary.mean_loss_a /= count;
  summary.mean_loss_b /= count;
  std::sort(ratios.begin(), ratios.end());
  summary.p50 = quantile(ratios, 0.5);
  summary.p95 = quantile(ratios, 0.95);
  summary.p99 = quantile(ratios, 0.99);
  return summary;
}

}  // namespace ltc
