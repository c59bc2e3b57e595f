// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The settings that the benchmark compares: a solver and how much work it is given.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fit/settings.h"

namespace ltc {

struct BenchSetting {
  std::string name;     // as the command line and files spell it
  std::string label;    // as a picture shows it
  std::string summary;  // one line
  FitSettings fit;
  // Where > 0, only so many steps are timed and the time of all fit.sgd.steps follows from them;
  // the error is then that of whatever stands in for the fit, if anything does (frontier.h).
  int timed_steps = 0;
};

// All that is built in, cheapest kind first within a solver. The fits of `seed`.
std::vector<BenchSetting> bench_settings(std::uint64_t seed);

// Those of `all` that a list "a,b,c" names, in its order; all of them for an empty list. Throws
// InputError for a name that is not there or stands twice.
std::vector<BenchSetting> select_settings(const std::vector<BenchSetting>& all,
                                          std::string_view list);

}  // namespace ltc
