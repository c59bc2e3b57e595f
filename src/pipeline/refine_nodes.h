// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The nodes of a table moved by the refinement, and what is stored of them.
#pragma once

#include <cstddef>
#include <vector>

#include "config/config.h"
#include "core/run_context.h"
#include "pipeline/cost.h"
#include "refine/refine.h"
#include "table/query_range.h"
#include "table/table.h"

namespace ltc {

// What of a node is refined, as the table stores it; a folded one normalised as the table asks.
void get_node(const Table& table, std::size_t flat, FoldedNode& node);
void set_node(const FoldedNode& node, std::size_t flat, Table& table);

// Moves the nodes' matrices for the sake of what lies between them, and states their losses anew.
// Nodes of `context.existing` take part and stay.
RefineReport refine_nodes(const Config& config, const RefineContext& context,
                          const std::vector<QueryRange>& ranges, const RunContext& run,
                          Table& table);

// The losses of all nodes with values, after their matrices were made otherwise than by fits of
// their own.
void measure_losses(const RunContext& run, Table& table);

}  // namespace ltc
