// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The nodes of a folded table before they are refined.
#pragma once

#include <cstddef>
#include <vector>

#include "config/config.h"
#include "core/run_context.h"
#include "table/query_range.h"
#include "table/table.h"

namespace ltc {

// The values of a small field, fitted over `ranges`. Its folds are of one branch everywhere, and as
// symmetric and continuous as those of a table should be.
Table nodes_of_small_field(const Config& config, const std::vector<QueryRange>& ranges,
                           const RunContext& run);

// Each node that is chosen fitted by itself, from the values that it has; but of the smoothest,
// which a field is not made for.
void fit_folded_nodes(const FitSettings& settings, const std::vector<bool>& chosen,
                      const RunContext& run, Table& table);

}  // namespace ltc
