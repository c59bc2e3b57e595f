// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Values for the entries that have none, for textures, which cannot hold NaN.
#pragma once

#include <cstddef>
#include <vector>

#include "table/table.h"

namespace ltc {

// For every entry the one whose values stand in for it: itself, or for a skipped or failed entry
// the nearest that is neither, by the sum of index distances along the axes; the smallest flat
// index where several are as near. Throws InputError if every entry is skipped or failed.
std::vector<std::size_t> nearest_fitted(const Table& table);

}  // namespace ltc
