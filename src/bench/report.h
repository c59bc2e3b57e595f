// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a benchmark run gives to machines and to talks: JSON, CSV, a picture of the frontier.
#pragma once

#include <string>
#include <vector>

#include "bench/frontier.h"
#include "picture/chart.h"

namespace ltc {

// A run with all that its reports need.
struct FrontierReport {
  FrontierTask task;
  FrontierRun run;
  std::vector<SettingSummary> summaries;
  // Where the tables of the task came from; empty where it has none.
  std::string published_file, reference_file;
};

// One object: the conditions of the run, and `settings`, one object a setting. Units are in the
// names; what was not measured is null.
std::string frontier_json(const FrontierReport& report);

// One line for each setting and entry.
std::string frontier_csv(const FrontierReport& report);

// Time for the whole table on one core against mean error of the lobes above alpha_min, both
// logarithmic. A setting without an error, or with none at all, has no point.
picture::Chart frontier_chart(const FrontierReport& report);

}  // namespace ltc
