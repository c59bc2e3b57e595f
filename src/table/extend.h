// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Adding entries to a table that has some already.
#pragma once

#include <string_view>
#include <vector>

#include "table/table.h"

namespace ltc {

// Throws InputError, naming `source` (the table's file) and what differs, unless `existing` has the
// grid (its BRDF too) and storage given: entries of another would be of no use in one table.
void require_extendable(const Table& existing, std::string_view source, const Grid& grid,
                        Storage storage);

// The entries that are needed and that `existing` skipped; what to fit. One that failed stays: it
// would fail again.
std::vector<bool> lacking_entries(const Table& existing, const std::vector<bool>& needed);

// The entries of `existing` bit for bit where its status is not `skipped`, those of `additions`
// elsewhere. Both must be extendable by each other.
//
// Seed, config, generator and time are those of `additions`, the run that made the file; its config
// is followed by those of the entries kept, in comments, so that it still reads as TOML. Extended
// time and again, a table carries its whole history there. It is refined where either is. If
// `additions` adds nothing, the result is `existing`, with all that it says.
Table extended(const Table& existing, const Table& additions);

}  // namespace ltc
