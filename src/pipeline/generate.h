// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The whole pipeline: nodes, fit, align, post-process. Writing files is src/export's.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/config.h"
#include "core/run_context.h"
#include "pipeline/cost.h"
#include "refine/field_fit.h"
#include "refine/refine.h"
#include "table/table.h"

namespace ltc {

struct GenerateReport {
  std::vector<std::pair<std::string, double>> stage_seconds;  // in order
  std::size_t fits = 0;                                       // lobes that were fitted
  std::size_t fits_of_whole_grid = 0;  // and that would have been, were every entry needed
  double largest_zeroed = 0;  // largest |entry| that equation (16) set to zero, unit third column
  std::size_t largest_zeroed_entry = 0;  // where
  std::optional<RefineReport> refine;    // where the config asks for it
  std::optional<FieldReport> field;      // the same
  // What of the config's range was refined on, where the table serves not all of it.
  std::optional<QueryRange> range_served;
};

class FitJournal;  // fit/fit_journal.h

// Makes the entries of `config`'s table that are `needed` (one flag a node). Throws InputError for
// a config that cannot be met, Interrupted when a stop is asked for; does not ask for memory.
// `journal` as for fit_table. Of several ranks (core/ranks.h) each has the whole table at the end.
Table generate_table(const Config& config, const std::vector<bool>& needed, const RunContext& run,
                     GenerateReport* report, FitJournal* journal = nullptr,
                     const RefineContext& context = {});

// The whole table.
Table generate_table(const Config& config, const RunContext& run, GenerateReport* report = nullptr);

}  // namespace ltc
