// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What generate tells at its end.
#pragma once

#include <cstddef>
#include <string>

#include "pipeline/run.h"

namespace ltc::cli {

// The commands that look into an entry, up to the entry's indices.
struct SummaryCommands {
  std::string fit;     // the fit that it had; empty where not all entries are of this run
  std::string stored;  // what the file holds; empty where that is the fit
};

inline constexpr std::size_t worst_count = 5;  // entries that are named

std::string summary_text(const RunReport& report, const SummaryCommands& commands);
std::string summary_json(const RunReport& report);

}  // namespace ltc::cli
