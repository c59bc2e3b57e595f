// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What diff tells of two tables: text, JSON, CSV, and the line of a check that failed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validate/comparison_summary.h"

namespace ltc::cli {

// A table and the file that it was read from.
struct NamedTable {
  std::string file;
  Table table;
};

struct DiffReport {
  DiffReport(NamedTable a, NamedTable b, const CompareSettings& settings,
             std::vector<EntryComparison> entries, std::optional<double> tolerance);

  NamedTable a, b;
  CompareSettings settings;
  std::vector<EntryComparison> entries;
  std::vector<ComparisonRow> rows;
  Coverage coverage;
  bool has_albedo;  // whether both tables have amplitude and Fresnel terms
  std::optional<double> tolerance;
  std::vector<Exceedance> exceeded;  // of the tolerance
};

std::string report_text(const DiffReport& report);
std::string report_json(const DiffReport& report);  // with a line break at its end

// Every entry in the order of the grid; a figure that there is none of is "nan".
std::string report_csv(const DiffReport& report);

// What keeps the report from passing its tolerance, in one line; empty if it has none or passes.
std::string failure_text(const DiffReport& report);

}  // namespace ltc::cli
