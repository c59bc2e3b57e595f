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

// What a refinement goes by beside the config.
struct RefineContext {
  std::vector<QueryRange> asked;    // what it serves; the config's range where there are none
  const Table* existing = nullptr;  // a table of the same grid that is extended: its entries take
                                    // part in look-ups and stay as they are
};

// Whether the table is made by interpolate/between_fits.h: all of it, unrefined, by a plain
// Gauss-Newton fit, with more than 20,000 lobes and a long axis.
bool is_interpolated(const Config& config, const std::vector<bool>& needed);

// What making a table costs, told before it is made.
struct Cost {
  std::size_t fits = 0;
  bool interpolated = false;     // fits are about so many, and lie at some of the nodes
  std::size_t memory_bytes = 0;  // about
  std::size_t queries = 0;       // look-ups that nodes are refined on; 0: no refinement
};
Cost cost_of(const Config& config, const std::vector<bool>& needed,
             const RefineContext& context = {});

// Throws InputError, with what is needed and what there is, where making the table would take more
// memory than is available: so many times, by the ranks on this machine.
void require_memory(const Config& config, const std::vector<bool>& needed,
                    const RefineContext& context = {}, int ranks_here = 1);

// Makes the entries of `config`'s table that are `needed` (one flag a node). Throws InputError for
// a config that cannot be met, Interrupted when a stop is asked for; does not ask for memory.
// `journal` as for fit_table. Of several ranks (core/ranks.h) each has the whole table at the end.
Table generate_table(const Config& config, const std::vector<bool>& needed, const RunContext& run,
                     GenerateReport* report, FitJournal* journal = nullptr,
                     const RefineContext& context = {});

// The whole table.
Table generate_table(const Config& config, const RunContext& run, GenerateReport* report = nullptr);

}  // namespace ltc
