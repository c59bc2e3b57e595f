// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The lobes that a table is refined on, and those that judge the refinement.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "ltc/folded.h"
#include "refine/refine_settings.h"
#include "table/grid.h"
#include "table/storage.h"

namespace ltc {

// The nodes that look-ups of a table go to.
struct TableNodes {
  const Grid& grid;
  Storage storage;
  const std::vector<bool>& has_values;
  Creases creases = {};  // of Storage::folded
};

struct WeightedLobes {
  std::vector<Lobe> lobes;
  std::vector<double> weights;  // c_p
};

// How many lobes are refined on, besides the nodes' own: so many for each cell that has all its
// nodes, and twice as many for every axis of one node. A cell then has half the corners for each
// such axis, and a node as many queries as on other grids.
std::size_t refined_query_count(const Grid& grid, const std::vector<bool>& has_values,
                                const RefineSettings& settings);

// Drawn from `asked` in turn, at least one range, on a low-discrepancy sequence; a share of them
// uniform in the table's own axes; and the nodes' own lobes.
WeightedLobes queries_to_refine_on(const Grid& grid, const std::vector<bool>& has_values,
                                   const std::vector<QueryRange>& asked,
                                   const RefineSettings& settings);

// Drawn at random, and of equal weight; no more than `most`, those refined on: a small part of a
// table is not judged for longer than it is refined.
WeightedLobes queries_held_out(double alpha_min, const LobeModel& model,
                               const std::vector<QueryRange>& asked, const RefineSettings& settings,
                               std::size_t most);

// `count` lobes, the ranges in turn: what draw(range, how many, which range) makes of each part.
std::vector<Lobe> lobes_in_turn(
    const std::vector<QueryRange>& asked, std::size_t count,
    const std::function<std::vector<Lobe>(const QueryRange&, std::size_t, std::size_t)>& draw);

}  // namespace ltc
