// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Two tables in use: the same random lobes asked of both, between their nodes, whatever their
// grids.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/run_context.h"
#include "judge/compare.h"
#include "judge/quality.h"
#include "table/queries.h"

namespace ltc {

// One lobe that is asked of both tables.
struct QueryComparison {
  Lobe lobe;
  QueryState state_a = QueryState::judged, state_b = QueryState::judged;
  EntryComparison lobes;  // of the two look-ups; all NaN unless both are judged
  // Errors under area lights, shares of the light that the lobe reflects: with the lobe's own
  // amplitude, which judges the shape alone, and with the table's. NaN where there is none.
  double area_light_a = not_compared, area_light_b = not_compared;
  double with_amplitude_a = not_compared, with_amplitude_b = not_compared;

  bool judged() const { return state_a == QueryState::judged && state_b == QueryState::judged; }
};

// The queries that both tables serve; nothing where they have no range of an axis in common.
std::optional<QueryRange> common_range(const Grid& a, const Grid& b);

// The queries of the settings, by their samples, directions, rectangles and seed: those of
// measure_quality, one and the same for both tables. The same bits with any number of threads.
std::vector<QueryComparison> compare_queries(const Table& a, const Table& b,
                                             const QualitySettings& settings,
                                             const RunContext& run);

// Which of two tables is nearer to GGX by one kind of figure, lobe for lobe.
struct Verdict {
  Statistics a, b;
  Statistics difference;                   // a - b, paired
  std::size_t a_nearer = 0, b_nearer = 0;  // the others are equal

  // Negative where A is nearer in the mean, positive where B is; 0 where the difference is within
  // two of its standard errors, which is as good as none.
  int sign() const;
};
// Of the pairs without NaN.
Verdict verdict_of(const std::vector<double>& a, const std::vector<double>& b);

// What the queries add up to.
struct QuerySummary {
  std::size_t judged = 0;
  std::size_t missing_a = 0, missing_b = 0;  // need an entry that the table has not
  std::size_t outside = 0;                   // of the axes of either
  // Judged, but the matrix has no inverse: area lights leave them out.
  std::size_t singular_a = 0, singular_b = 0;
  Verdict look_ups;  // losses over the lobe's spread
  Verdict area_lights, area_lights_with_amplitude;
  Statistics relative_distance, amplitude_difference, fresnel_difference;
};
QuerySummary summarize_queries(const std::vector<QueryComparison>& queries);

}  // namespace ltc
