// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/refine_nodes.h"

#include <algorithm>
#include <iterator>

#include "pipeline/first_entries.h"
#include "postprocess/normalise.h"

namespace ltc {
namespace {

void get_node(const Table& table, std::size_t flat, Eigen::Matrix3d& node) {
  node = table.stored_at(flat);
}
void set_node(const Eigen::Matrix3d& node, std::size_t flat, Table& table) {
  table.set_stored(flat, normalise(table.storage, node));
}

// Their losses, of those that are `chosen`, after their matrices were made otherwise than by fits
// of their own.
template <typename Node>
void measure_losses(const std::vector<bool>& chosen, const RunContext& run, Table& table) {
  std::vector<Node> stored(table.grid.size());
  for (std::size_t flat = 0; flat < stored.size(); ++flat)
    get_node(table, flat, stored[flat]);
  const std::vector<double> losses =
      node_losses({table.grid, table.storage, chosen, table.creases}, stored, run);
  for (std::size_t flat = 0; flat < losses.size(); ++flat)
    if (chosen[flat])
      table.sw_loss[flat] = static_cast<float>(losses[flat]);
}

// Moves the nodes' matrices for the sake of what lies between them, and states their losses anew.
template <typename Node>
RefineReport refine_nodes(const Config& config, const RefineContext& context,
                          const std::vector<QueryRange>& ranges, const RunContext& run,
                          Table& table) {
  const std::size_t count = table.grid.size();
  std::vector<Node> stored(count);
  std::vector<bool> present(count), movable(count);
  for (std::size_t flat = 0; flat < count; ++flat) {
    const bool made = has_values(table.status[flat]);
    const bool kept = !made && context.has_existing(flat);
    get_node(kept ? *context.existing : table, flat, stored[flat]);
    present[flat] = made || kept;
    movable[flat] = made && !(config.refine.keep_smoothest && is_smoothest(table.grid, flat));
  }
  const RefineReport report = refine({table.grid, table.storage, present, table.creases}, movable,
                                     ranges, config.refine, run, stored);
  if (!report.kept)
    return report;
  for (std::size_t flat = 0; flat < count; ++flat)
    if (movable[flat])
      set_node(stored[flat], flat, table);
  measure_losses<Node>(movable, run, table);
  return report;
}

}  // namespace

void get_node(const Table& table, std::size_t flat, FoldedNode& node) {
  node << flattened(table.stored_at(flat)), table.fold[2 * flat], table.fold[2 * flat + 1];
}
void set_node(const FoldedNode& node, std::size_t flat, Table& table) {
  set_node(matrix_of(node), flat, table);
  table.fold[2 * flat] = static_cast<float>(node[9]);
  table.fold[2 * flat + 1] = static_cast<float>(node[10]);
}

RefineReport refine_nodes(const Config& config, const RefineContext& context,
                          const std::vector<QueryRange>& ranges, const RunContext& run,
                          Table& table) {
  return is_folded(table) ? refine_nodes<FoldedNode>(config, context, ranges, run, table)
                          : refine_nodes<Eigen::Matrix3d>(config, context, ranges, run, table);
}

void measure_losses(const RunContext& run, Table& table) {
  std::vector<bool> present(table.grid.size());
  std::transform(table.status.begin(), table.status.end(), present.begin(), has_values);
  if (is_folded(table))
    measure_losses<FoldedNode>(present, run, table);
  else
    measure_losses<Eigen::Matrix3d>(present, run, table);
}

}  // namespace ltc
