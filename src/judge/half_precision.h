// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What 16-bit textures cost: how far rounding a stored matrix moves its lobe.
#pragma once

#include <string>
#include <vector>

#include "core/run_context.h"
#include "table/table.h"

namespace ltc {

// Sliced-Wasserstein distance between the LTC of an entry and that of its matrix S rounded to half
// precision, over the spread of the first; infinite where rounding makes S singular, mirrored or
// infinite. NaN at entries that are not `judged`, whose matrices need no inverse. Throws
// Interrupted.
std::vector<double> half_precision_errors(const Table& table, const std::vector<bool>& judged,
                                          const RunContext& run);

// The worst entry, and what remains at other values of alpha: the step of 16 bits in a direction is
// the same for all lobes, so that only the smoothest feel it. In words, of one line; empty where
// nothing was judged.
std::string half_precision_text(const Grid& grid, const std::vector<double>& errors);

}  // namespace ltc
