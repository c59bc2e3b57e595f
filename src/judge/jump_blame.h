// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Which of two adjacent entries a jump between them is the fault of.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "table/grid.h"

namespace ltc {

// `jumps` has four values an entry: the jump to the entry before it along each axis, NaN where
// there is none to compare. A broken entry jumps to all its neighbours, and they to it alone: so,
// from the largest jump down, each is counted to that of the two entries whose jumps are larger in
// the mean, and this entry with all its jumps is put aside. What is left is judged without it:
// where broken entries are adjacent, none lends its jumps to another or to sound ones.
//
// Behind an entry that is put aside with a jump above `suspicious`, the entries on its two sides
// are adjacent: `jump_between` says their jump. (For the first thousand; a table with more is
// broken everywhere.)
//
// Returns one value an entry: the jump that is counted to it, 0 if none is, NaN without neighbours.
std::vector<double> blame_jumps(
    const Grid& grid, std::vector<float> jumps, double suspicious,
    const std::function<double(std::size_t, std::size_t)>& jump_between);

}  // namespace ltc
