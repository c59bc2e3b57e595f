// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How good a table is: at its nodes, between them where renderers look, and under area lights.
//
// Losses are relative: the held-out sliced-Wasserstein loss over the lobe's spread, so that 0 is
// the lobe itself and 1 as far off as a single direction (judge/held_out.h). Errors under area
// lights are shares of the light that the whole lobe reflects (judge/area_light.h). The floor is
// what a fit of the very lobe that is asked for attains: a table costs what it is above the floor,
// the family of LTCs costs the floor.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/run_context.h"
#include "fit/settings.h"
#include "judge/area_light.h"
#include "judge/held_out.h"
#include "judge/statistics.h"
#include "ltc/horizon.h"
#include "table/lookup.h"
#include "table/queries.h"
#include "table/table.h"

namespace ltc {

// Of the fits that the floor is made of: better than a table's nodes have to be.
FitSettings floor_fit_settings();

struct QualitySettings {
  // All nodes of a table with at most so many, else so many drawn at random.
  std::size_t most_nodes = 4096;
  std::size_t node_samples = 16384;  // of HeldOutJudge
  std::size_t node_directions = 32;
  // So many nodes, drawn at random, are fitted by themselves by default settings, to see what of a
  // table's loss is not that of such fits; none of folded tables.
  std::size_t fitted_nodes = 0;
  std::size_t queries = 600;  // random ones in `range`
  QueryRange range;
  std::size_t query_samples = 16384;
  std::size_t query_directions = 32;
  std::size_t quads = 64;            // rectangles a query, of AreaLightJudge
  std::size_t quad_samples = 16384;  // weighted samples of the lobe, in two halves
  std::uint64_t seed = 20220712;     // of nodes, queries, samples, directions and rectangles
  std::size_t worst = 6;             // queries to name
  // How lobes are judged; those of the floor are fitted so.
  HorizonMode horizon = HorizonMode::clipped;
  FitSettings floor_fit = floor_fit_settings();
};

// A lobe that is asked for, and the LTC fitted to it, folded where the settings' floor is.
struct QueryFloor {
  Lobe lobe;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  double relative_loss = 0;
  AreaLightError area_light;  // with the lobe's own amplitude
  Fold fold = {};
};

enum class QueryState {
  judged,
  outside,  // beyond the table's axes
  missing,  // needs an entry that is skipped or failed
};
constexpr EnumNames<QueryState, 3> enum_names(QueryState) {
  return {"state",
          {{{QueryState::judged, "judged"},
            {QueryState::outside, "outside"},
            {QueryState::missing, "missing"}}}};
}

// What a table answers when it is asked for a lobe.
struct Answer {
  QueryState state = QueryState::judged;
  LookUp found;
};
Answer ask(const Table& table, const Lobe& lobe);

// The judges of a query. Directions drawn once for all would err alike for every lobe, and the mean
// with them: 32 of them by 4 %, and 16 rectangles by 6 %. So every lobe has its own, the same
// whichever table is judged; of the rectangles by the draw of AreaLightJudge::set_lobe.
HeldOutJudge query_judge(const QualitySettings& settings, std::size_t query);
AreaLightJudge area_light_judge(const QualitySettings& settings);

// What the table's look-up makes of it. NaN where it is not judged.
struct QueryQuality {
  QueryState state = QueryState::judged;
  double relative_loss = 0;
  // With the lobe's own amplitude, which judges the shape alone, and with the table's. NaN for a
  // matrix without an inverse, and for a table without amplitudes.
  AreaLightError area_light;
  AreaLightError area_light_with_amplitude;
  double below_horizon = 0;  // share of the LTC
};

// The judged queries of one range of a parameter, first <= parameter < last.
struct Band {
  double first = 0, last = 0;
  std::size_t queries = 0;
  double relative_loss = 0, floor_loss = 0;                 // means; NaN without queries
  double area_light_error = 0, floor_area_light_error = 0;  // likewise
};
struct Bands {
  std::string parameter, unit;  // "perceptual roughness", ""; "theta", "°"
  std::vector<Band> bands;
};

struct QualityReport {
  QualitySettings settings;

  std::vector<double> node_losses;  // relative, one a node; NaN where it is not judged
  std::size_t nodes_without_values = 0;
  // Loss over that of a fit of the same lobe, by the same samples, one for each of the fitted
  // nodes.
  std::vector<double> node_fit_ratios;
  Statistics node_fits;  // of these; no index
  Statistics nodes;      // of node_losses; its index is flat

  std::vector<QueryFloor> floors;     // one a query
  std::vector<QueryQuality> queries;  // likewise
  std::size_t queries_outside = 0, queries_missing = 0;
  std::size_t queries_singular = 0;  // judged, but their matrix has no inverse
  // Over the judged queries; indices are those of `queries`.
  Statistics query_losses, floor_losses;
  // Shares of LTCs below the horizon: of all nodes with values, of the queries, of their fits.
  Statistics nodes_below_horizon, below_horizon, floor_below_horizon;
  Statistics area_light, area_light_with_amplitude, floor_area_light;
  double area_light_noise = 0;  // standard error of a rectangle's sampled share, root mean square
  double area_light_mean_noise = 0;  // its part in the means: noise / sqrt(queries * quads)
  std::vector<Bands> bands;          // by roughness, theta, lambda and phi
  // By how far they are above the floor, those that are furthest first.
  std::vector<std::size_t> worst_queries;
};

// The queries of the settings, each fitted by itself; `grid` is one of the tables which they are
// for. The same bits with any number of threads, as below. Throws Interrupted when a stop
// is asked for, InputError for settings without samples or directions.
std::vector<QueryFloor> fit_queries(const QualitySettings& settings, const Grid& grid,
                                    const RunContext& run);

// `floors` are those of fit_queries with the same settings, so that several tables can share them.
QualityReport measure_quality(const Table& table, const QualitySettings& settings,
                              std::vector<QueryFloor> floors, const RunContext& run);

// With floors of its own, of queries in the part of the settings' range that the table serves
// (query_range_of); the report's settings say which.
QualityReport measure_quality(const Table& table, const QualitySettings& settings,
                              const RunContext& run);

}  // namespace ltc
