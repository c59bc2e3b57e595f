// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Measures run time against error: several settings on the same entries, in one run.
//
// All settings fit an entry before any fits the next, so that whatever else the machine does hits
// them alike. One thread, and processor time: times are those of one core that is not shared.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/setting.h"
#include "core/run_context.h"
#include "judge/comparison_summary.h"
#include "table/table.h"

namespace ltc {

// Lobes of the grid that symmetry leaves to be fitted, in the grid's order.
std::vector<std::size_t> fitted_entries(const Grid& grid);

// At most `count` of the entries, evenly strided, each in the middle of its stride.
std::vector<std::size_t> strided(const std::vector<std::size_t>& entries, std::size_t count);

struct FrontierTask {
  Grid grid;
  std::vector<BenchSetting> settings;
  std::vector<std::size_t> entries;  // flat indices of fitted entries
  CompareSettings judge;
  // What stands in for the settings of which only a few steps are timed: the matrices of a
  // published table of the same grid, or whole fits of so many of the entries, or nothing.
  const Table* published = nullptr;
  std::size_t whole_fits = 0;
  // What losses are divided by; null: the best of all settings at each entry.
  const Table* reference = nullptr;
};

struct EntryMeasurement {
  double seconds = 0;  // processor time of the fit, the neighbours' sweep included
  double loss = 0;     // held out; NaN where nothing was judged or there is no finite matrix
  int steps = 0;
  bool judged = false;  // there was a matrix to judge, finite or not
};

struct FrontierRun {
  std::vector<std::vector<EntryMeasurement>> measurements;  // [setting][entry of the task]
  std::vector<double> reference_loss;                       // one an entry of the task
};

// Throws InputError where a table has another grid than the task, Interrupted when a stop is asked
// for.
FrontierRun measure_frontier(const FrontierTask& task, const RunContext& context = {});

// Where the judged matrices of a setting come from.
enum class ErrorSource { own_fits, published_table, whole_fits, none };
constexpr EnumNames<ErrorSource, 4> enum_names(ErrorSource) {
  return {"source of errors",
          {{{ErrorSource::own_fits, "its own fits"},
            {ErrorSource::published_table, "the published table"},
            {ErrorSource::whole_fits, "whole fits of some entries"},
            {ErrorSource::none, "nothing"}}}};
}

struct SettingSummary {
  Statistics seconds;         // an entry
  double table_seconds = 0;   // the mean times all fitted entries of the grid
  bool extrapolated = false;  // from the first steps
  ErrorSource error_source = ErrorSource::own_fits;
  Statistics ratios;  // held-out loss over the reference's, of the judged and finite
  // Of these, the lobes above alpha_min. Those at it are as good as mirrors, and a fit that misses
  // them at all misses them by many times their width, which drowns all else in a mean.
  Statistics rough_ratios;
  std::size_t judged = 0;    // entries with a matrix, finite or not
  std::size_t failures = 0;  // of these, those without a finite matrix
};

// One a setting of the task.
std::vector<SettingSummary> summarize(const FrontierTask& task, const FrontierRun& run);

}  // namespace ltc
