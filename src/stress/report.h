// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a stress run gives to machines and to readers: JSON, and maps over the lobes.
#pragma once

#include <string>
#include <vector>

#include "picture/heat_map.h"
#include "stress/verdict.h"

namespace ltc {

// A solver's run with all that its reports need.
struct StressReport {
  std::string name;  // of the solver's settings
  StressAxes axes;   // of those lobes of the task that are on the grid
  StressTask task;
  StressRun run;
  StressVerdict verdict;
  bool must_pass = true;  // else it shows where a solver breaks, and no bar is held up to it
  std::vector<std::string> commands;  // what fits the worst again, in the order of verdict.worst
};

// One object: the conditions, and `solvers`, one object a report. Units are in the names.
std::string stress_json(const std::vector<StressReport>& reports);

// One line for each fit.
std::string stress_csv(const std::vector<StressReport>& reports);

// Two tiles for each theta, from the program's own starts and from bad ones; in a tile alpha
// downwards and lambda to the right. Over phi and the starts, the share of fits that succeed, and
// the largest ratio of the finite ones.
picture::TiledMap success_map(const StressReport& report);
picture::TiledMap ratio_map(const StressReport& report);

}  // namespace ltc
