// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The page that a person opens to decide whether a table is sound and good.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/run_context.h"
#include "judge/invariants.h"
#include "judge/quality.h"
#include "judge/quality_summary.h"
#include "table/table.h"

namespace ltc {

// What validate found out about a table.
struct Validation {
  std::string file;  // as it was named
  Table table;
  std::vector<InvariantResult> invariants;
  std::optional<QualityReport> quality;  // nothing where it was not asked for
  std::vector<ThresholdCheck> thresholds;
  // What a person types to look into a lobe or an entry.
  std::function<std::string(const Lobe&)> query_command = [](const Lobe&) { return ""; };
  std::function<std::string(std::size_t)> entry_command = [](std::size_t) { return ""; };
};

// What the limits of a table depend on, in one line: whether it was refined, and its precision.
std::string kind_text(const Table& table);

// Whether every invariant holds and no threshold is passed.
bool is_sound(const Validation& validation);

struct PageSettings {
  std::size_t lobes = 3;              // worst queries that are drawn
  std::size_t sphere_size = 200;      // pixels; 0 leaves the spheres out
  std::size_t sphere_samples = 1024;  // of the GGX reference, a pixel
};

// One HTML file's content, with all pictures within. Throws Interrupted when a stop is asked for,
// std::bad_optional_access without quality.
std::string validation_page(const Validation& validation, const PageSettings& settings,
                            const RunContext& run);

}  // namespace ltc
