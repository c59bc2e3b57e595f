// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/compare.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <map>

#include "align/align.h"
#include "core/error.h"
#include "core/parallel.h"
#include "table/entry_text.h"

namespace ltc {
namespace {

// All that an entry's figures depend on, bit by bit: alpha_x, alpha_y, the view direction, both
// matrices and folds.
using LobeBits = std::array<std::uint64_t, 27>;

LobeBits bits_of(const Lobe& lobe, const LtcLobe& a, const LtcLobe& b) {
  LobeBits bits;
  auto next = bits.begin();
  const auto add = [&](double value) { *next++ = std::bit_cast<std::uint64_t>(value); };
  add(lobe.alpha_x);
  add(lobe.alpha_y);
  for (const double value : lobe.omega_v())
    add(value);
  for (int i = 0; i < 9; ++i) {
    add(a.matrix(i));
    add(b.matrix(i));
  }
  for (const LtcLobe* ltc : {&a, &b}) {
    add(ltc->fold.k);
    add(ltc->fold.g);
  }
  return bits;
}

// The first entry of those that are the same, for every entry.
std::vector<std::size_t> first_of_same(const Table& a, const Table& b) {
  std::map<LobeBits, std::size_t> first;
  std::vector<std::size_t> result(a.grid.size());
  for (std::size_t flat = 0; flat < result.size(); ++flat)
    result[flat] =
        first.try_emplace(bits_of(a.grid.lobe(flat), a.ltc_at(flat), b.ltc_at(flat)), flat)
            .first->second;
  return result;
}

double difference(float a, float b) {
  return std::abs(static_cast<double>(a) - static_cast<double>(b));
}

}  // namespace

EntryComparison compare_lobes(const Lobe& lobe, const LtcLobe& a, const LtcLobe& b,
                              HeldOutJudge& judge) {
  const bool both = a.matrix.allFinite() && b.matrix.allFinite();
  LtcLobe nearest_b = b;
  if (both && b.creases.empty())
    nearest_b.matrix = align_to(a.matrix, b.matrix);
  const PairJudgement judgement = judge.judge_pair(lobe, a, nearest_b);
  EntryComparison entry{judgement.loss_a, judgement.loss_b, judgement.spread, judgement.distance};
  if (both)
    entry.matrix_difference =
        (a.matrix / a.matrix.col(2).norm() - nearest_b.matrix / nearest_b.matrix.col(2).norm())
            .cwiseAbs()
            .maxCoeff<Eigen::PropagateNaN>();
  return entry;
}

void require_same_grid(const Grid& a, const Grid& b) {
  if (a == b)
    return;
  if (a.shape() != b.shape())
    throw InputError(
        fmt::format("the tables have different shapes: {} and {}; entries can only be "
                    "compared on the same grid",
                    shape_text(a), shape_text(b)));
  if (a.layout != b.layout)
    throw InputError(
        fmt::format("the tables have different axes: those of one hold {}, of the other {}; "
                    "entries can only be compared on the same grid",
                    name_of(a.layout), name_of(b.layout)));
  throw InputError(
      "the tables have different axes or another alpha_min; entries can only be "
      "compared on the same grid");
}

std::vector<EntryComparison> compare_tables(const Table& a, const Table& b,
                                            const CompareSettings& settings,
                                            const RunContext& run) {
  require_same_grid(a.grid, b.grid);
  const std::vector<std::size_t> first = first_of_same(a, b);
  std::vector<std::size_t> to_judge;
  for (std::size_t flat = 0; flat < first.size(); ++flat)
    if (first[flat] == flat)
      to_judge.push_back(flat);

  std::vector<EntryComparison> entries(first.size());
  const HeldOutJudge prototype(settings.samples, settings.directions, settings.seed);
  parallel_for_each<HeldOutJudge>(
      "compare", to_judge.size(), run, [&] { return prototype; },
      [&](std::size_t i, HeldOutJudge& judge) {
        const std::size_t flat = to_judge[i];
        entries[flat] = compare_lobes(a.grid.lobe(flat), a.ltc_at(flat), b.ltc_at(flat), judge);
      });
  for (std::size_t flat = 0; flat < entries.size(); ++flat) {
    entries[flat] = entries[first[flat]];
    entries[flat].amplitude_difference = difference(a.amplitude[flat], b.amplitude[flat]);
    entries[flat].fresnel_difference = difference(a.fresnel[flat], b.fresnel[flat]);
  }
  return entries;
}

}  // namespace ltc
