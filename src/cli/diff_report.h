// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What diff tells of two tables: text, JSON, CSV, and the line of a check that failed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "judge/comparison_summary.h"
#include "judge/query_comparison.h"

namespace ltc::cli {

// A table and the file that it was read from.
struct NamedTable {
  std::string file;
  Table table;
};

// How to judge: the nodes, and what lies between them.
struct DiffSettings {
  CompareSettings nodes;
  QualitySettings use;
};

// The nodes of two tables of one grid, lobe by lobe.
struct NodeReport {
  NodeReport(const Table& a, const Table& b, std::vector<EntryComparison> entries);

  std::vector<EntryComparison> entries;
  std::vector<ComparisonRow> rows;
  Coverage coverage;
  Verdict losses;  // over the lobe's spread; without mirrors where there are others
};

struct DiffReport {
  // `entries` is empty where the grids differ.
  DiffReport(NamedTable a, NamedTable b, const DiffSettings& settings,
             std::optional<std::vector<EntryComparison>> entries,
             std::vector<QueryComparison> queries, std::optional<double> tolerance);

  const Grid& grid() const { return a.table.grid; }  // that of the nodes

  NamedTable a, b;
  DiffSettings settings;
  std::optional<NodeReport> nodes;
  std::vector<QueryComparison> queries;
  QuerySummary use;
  bool has_albedo;  // whether both tables have amplitude and Fresnel terms
  std::optional<double> tolerance;
  // Of the tolerance, at the nodes; at the queries where the grids differ.
  std::vector<Exceedance> exceeded;
};

std::string report_text(const DiffReport& report);
std::string report_json(const DiffReport& report);  // with a line break at its end

// Every entry in the order of the grid, then every query; a figure that there is none of is "nan".
std::string report_csv(const DiffReport& report);

// What keeps the report from passing its tolerance, in one line; empty if it has none or passes.
std::string failure_text(const DiffReport& report);

// ---- Parts of the above ----

// What keeps entries or queries from being compared, one phrase each.
std::vector<std::string> coverage_faults(const DiffReport& report);

// Where an exceedance is largest: "entry 3,0,7,4", or a query's lobe.
std::string place_text(const DiffReport& report, std::size_t index);

// Worst entries; what is nothing, as between equal tables, is in none.
struct WorstList {
  std::string name;   // in JSON
  std::string title;  // in text
  std::vector<std::size_t> entries;
};
// By ratio and by distance; where mirrors take places, those that they displaced as well.
std::vector<WorstList> worst_lists(const DiffReport& report);

// The queries where A's look-up is furthest behind B's, over the lobe's spread.
std::vector<std::size_t> worst_queries(const DiffReport& report);

}  // namespace ltc::cli
