// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Which of the queries that are of interest a table serves.
#pragma once

#include "table/grid.h"
#include "table/queries.h"

namespace ltc {

// What of a range a table of this grid serves: its ends where the table covers them (Reduction),
// else clamped to the axes. A range beyond the axes is left with their nearest values.
QueryRange clamped_range(const Grid& grid, const QueryRange& range);

// The queries that a table of this grid is made and judged for, where `wanted` are of interest: the
// same, but the axes' own extent in each parameter of which nothing wanted is left.
QueryRange query_range_of(const Grid& grid, const QueryRange& wanted);

}  // namespace ltc
