// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the comparison of two tables adds up to: statistics, worst entries, a check.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "judge/compare.h"
#include "judge/statistics.h"
#include "table/grid.h"

namespace ltc {

// Of the ratio loss_a / loss_b over the entries that both tables have and `include` is true for; of
// all where it is empty.
Statistics ratio_statistics(const std::vector<EntryComparison>& entries,
                            const std::vector<bool>& include = {});

// A part of the table, and what its entries add up to.
struct ComparisonRow {
  std::string name;                        // "all", "alpha 0.143"
  std::size_t entries = 0;                 // that both tables have and whose lobes can be judged
  std::size_t a_nearer = 0, b_nearer = 0;  // to GGX; the others are equal
  Statistics loss_a, loss_b, ratio;
  Statistics relative_distance, distance;
  Statistics matrix_difference, amplitude_difference, fresnel_difference;
};

// Whether a plane's lobes are the sharpest of the table, alpha <= alpha_min: mirrors, to a person.
bool is_mirror(const Grid& grid, std::size_t alpha_index);

// Whether both kinds of plane exist.
bool has_mirrors_and_others(const Grid& grid);

// The whole table; what is left without mirrors, where both kinds of plane exist; every plane of
// alpha.
std::vector<ComparisonRow> summarize_rows(const Grid& grid,
                                          const std::vector<EntryComparison>& entries);

// One figure of every entry.
template <class Figure>
std::vector<double> figures_of(const std::vector<EntryComparison>& entries, Figure&& figure) {
  std::vector<double> values;
  values.reserve(entries.size());
  for (const EntryComparison& entry : entries)
    values.push_back(figure(entry));
  return values;
}

// The indices of at most `count` values, falling, NaN left out; equal ones in their order.
std::vector<std::size_t> largest_of(std::span<const double> values, std::size_t count);

// Whether a table holds amplitude and Fresnel terms at all; arrays of matrices do not.
bool has_albedo(const Table& table);

// Entries of which one table has values and the other none, and those that both have but of which
// some figure is not finite: a matrix that is finite and yet maps directions to nothing, or an
// amplitude or Fresnel term that is missing in a table that has others.
struct Coverage {
  std::size_t only_a = 0, only_b = 0, unjudged = 0;
  std::size_t first_only_a = 0, first_only_b = 0, first_unjudged = 0;  // flat indices
};
Coverage coverage_of(const Table& a, const Table& b, const std::vector<EntryComparison>& entries);

// One figure that passes a tolerance somewhere.
struct Exceedance {
  std::string figure;       // "lobe distance", "amplitude", "Fresnel term"
  std::size_t entries = 0;  // in how many
  double largest = 0;
  std::size_t largest_entry = 0;
};

// The figures that a tolerance bounds: the distance between the two lobes over the lobe's spread,
// and the absolute differences of amplitude and Fresnel term where both tables have them. All are
// shares of 1. What is missing on one side is no figure: see Coverage.
std::vector<Exceedance> exceedances(const std::vector<EntryComparison>& entries, double tolerance);

}  // namespace ltc
