// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/folded_start.h"

#include <cstdint>
#include <memory>

#include "core/spread.h"
#include "fit/fit_table.h"
#include "fit/solver.h"
#include "pipeline/first_entries.h"
#include "pipeline/refine_nodes.h"
#include "refine/field_fit.h"
#include "table/field_table.h"
#include "table/symmetry.h"

namespace ltc {
namespace {

// Numbers of the field that a folded table starts from.
constexpr int folded_start_size = 512;

// The node itself, or at theta = 0, where every phi has the same lobe, the first one with values.
std::size_t first_of_same(const Table& table, std::size_t flat) {
  NodeIndex node = table.grid.node(flat);
  if (!looks_upward(table.grid.theta.nodes[node.theta]))
    return flat;
  for (node.phi = 0; !has_values(table.status[table.grid.flat(node)]);)
    ++node.phi;
  return table.grid.flat(node);
}

}  // namespace

Table nodes_of_small_field(const Config& config, const std::vector<QueryRange>& ranges,
                           const RunContext& run) {
  FieldSettings settings = config.field;
  settings.size = folded_start_size;
  settings.half = false;
  const Field field =
      fit_field(config.grid.alpha_min, *config.grid.model, ranges, settings, config.refine, run);
  Table table = table_of_field(field, config.grid, Storage::folded, run);
  table.field.reset();
  return table;
}

void fit_folded_nodes(const FitSettings& settings, const std::vector<bool>& chosen,
                      const RunContext& run, Table& table) {
  const std::unique_ptr<Solver> solver = make_solver(settings);
  const auto fit = [&](std::size_t flat, FitWorkspace& workspace) {
    FitRequest request;
    request.lobe = table.grid.lobe(flat);
    request.seed = entry_seed(settings.seed, flat);
    if (!is_smoothest(table.grid, flat)) {
      request.incumbent.emplace();
      request.incumbent->matrix = table.matrix_at(flat);
      request.incumbent->fold = table.fold_at(flat);
    }
    request.progress = run.progress;
    return solver->fit(request, workspace, nullptr);
  };
  spread_for_each<FitWorkspacePointer>(
      "fit", Spreading::moving, table.grid.size(), run, make_fit_workspace,
      [&](std::size_t flat, FitWorkspacePointer& workspace) {
        if (!chosen[flat] || first_of_same(table, flat) != flat)
          return;
        const FitResult result = fit(flat, *workspace);
        const Lobe lobe = table.grid.lobe(flat);
        FoldedNode node;
        node << flattened(stored_from_matrix(table.storage, result.matrix, lobe)),
            kappa_of(result.fold, lobe), result.fold.g;
        set_node(node, flat, table);
        table.sw_loss[flat] = static_cast<float>(result.loss);
        table.iterations[flat] = static_cast<std::uint16_t>(result.steps);
      },
      [&](std::size_t flat, auto&& take) {
        for (std::size_t i = 0; i < 9; ++i)
          take(bytes_of(table.stored[9 * flat + i]));
        for (std::size_t i = 0; i < 2; ++i)
          take(bytes_of(table.fold[2 * flat + i]));
        take(bytes_of(table.sw_loss[flat]));
        take(bytes_of(table.iterations[flat]));
      });
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat)
    if (chosen[flat] && first_of_same(table, flat) != flat) {
      FoldedNode node;
      get_node(table, first_of_same(table, flat), node);
      set_node(node, flat, table);
      table.status[flat] = Status::copied;
    }
}

}  // namespace ltc
