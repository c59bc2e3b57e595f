// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A table's .h5 as fuzzers read it, who learn nothing of what happens in another process.
#pragma once

#include <filesystem>

#include "table/table.h"

namespace ltc {

// Without the guard of core/hdf5_guard.h.
Table read_hdf5_unguarded(const std::filesystem::path& path);

}  // namespace ltc
