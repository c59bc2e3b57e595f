// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/refine_queries.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

namespace ltc {
namespace {

constexpr std::uint64_t held_out_seed = 20220712;

void add(const std::vector<Lobe>& more, double share, WeightedLobes& queries) {
  queries.lobes.insert(queries.lobes.end(), more.begin(), more.end());
  queries.weights.insert(queries.weights.end(), more.size(),
                         share / static_cast<double>(more.size()));
}

// Uniform in the interpolation coordinates: no cell without a query.
std::vector<Lobe> lobes_of_table(const Grid& grid, std::size_t count) {
  std::vector<Lobe> lobes;
  for (const std::array<double, 4>& u : lattice_points(0, count)) {
    const double alpha = grid.alpha.value(u[0]);
    lobes.push_back({std::max(alpha, grid.alpha_min),
                     std::max(grid.lambda.value(u[1]) * alpha, grid.alpha_min),
                     grid.theta.value(u[2]), grid.phi.value(u[3]), grid.model});
  }
  return lobes;
}

std::vector<Lobe> lobes_of_nodes(const Grid& grid, const std::vector<bool>& has_values) {
  std::vector<Lobe> lobes;
  for (std::size_t flat = 0; flat < grid.size(); ++flat)
    if (has_values[flat])
      lobes.push_back(grid.lobe(flat));
  return lobes;
}

// The cells that can be asked: each counts at its first node, the one with a next node that has
// values, or none before, along every axis.
std::size_t cell_count(const Grid& grid, const std::vector<bool>& has_values) {
  const auto present = [&](std::optional<std::size_t> node) { return node && has_values[*node]; };
  std::size_t cells = 0;
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    bool first = has_values[flat];
    for (std::size_t axis = 0; axis < Grid::axis_count && first; ++axis)
      first = present(grid.after(flat, axis)) || !present(grid.before(flat, axis));
    cells += first;
  }
  return cells;
}

}  // namespace

std::vector<Lobe> lobes_in_turn(
    const std::vector<QueryRange>& asked, std::size_t count,
    const std::function<std::vector<Lobe>(const QueryRange&, std::size_t, std::size_t)>& draw) {
  std::vector<Lobe> lobes;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const std::size_t part = (count + asked.size() - 1 - i) / asked.size();
    const std::vector<Lobe> more = draw(asked[i], part, i);
    lobes.insert(lobes.end(), more.begin(), more.end());
  }
  return lobes;
}

std::size_t refined_query_count(const Grid& grid, const std::vector<bool>& has_values,
                                const RefineSettings& settings) {
  std::size_t count =
      cell_count(grid, has_values) * static_cast<std::size_t>(settings.queries_per_cell);
  for (const std::size_t nodes : grid.shape())
    if (nodes == 1)
      count *= 2;
  return count;
}

WeightedLobes queries_to_refine_on(const Grid& grid, const std::vector<bool>& has_values,
                                   const std::vector<QueryRange>& asked,
                                   const RefineSettings& settings) {
  const std::size_t count = refined_query_count(grid, has_values, settings);
  const auto of_table = static_cast<std::size_t>(settings.table_share * static_cast<double>(count));
  const double free_weight = 1 - settings.node_weight;
  WeightedLobes queries;
  add(lobes_in_turn(asked, count - of_table,
                    [&](const QueryRange& range, std::size_t part, std::size_t) {
                      return lattice_queries(range, 0, part, grid.alpha_min, *grid.model);
                    }),
      free_weight * (1 - settings.table_share), queries);
  add(lobes_of_table(grid, of_table), free_weight * settings.table_share, queries);
  add(lobes_of_nodes(grid, has_values), settings.node_weight, queries);
  return queries;
}

WeightedLobes queries_held_out(double alpha_min, const LobeModel& model,
                               const std::vector<QueryRange>& asked, const RefineSettings& settings,
                               std::size_t most) {
  WeightedLobes queries;
  add(lobes_in_turn(asked, std::min(static_cast<std::size_t>(settings.held_out_queries), most),
                    [&](const QueryRange& range, std::size_t part, std::size_t i) {
                      return random_queries(range, part, held_out_seed + i, alpha_min, model);
                    }),
      1, queries);
  return queries;
}

}  // namespace ltc
