// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/diff_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/lobe_words.h"
#include "table/entry_text.h"

namespace ltc::cli {
namespace {

constexpr std::size_t worst_count = 5, worst_query_count = 3;

// Mirrors left out where there are others: refined, they miss by many times their width, which
// drowns all else in a mean.
Verdict verdict_of_nodes(const Grid& grid, const std::vector<EntryComparison>& entries) {
  const bool all = !has_mirrors_and_others(grid);
  std::vector<double> a(entries.size(), not_compared), b = a;
  for (std::size_t flat = 0; flat < entries.size(); ++flat)
    if (all || !is_mirror(grid, grid.node(flat).alpha)) {
      a[flat] = entries[flat].loss_a / entries[flat].spread;
      b[flat] = entries[flat].loss_b / entries[flat].spread;
    }
  return verdict_of(a, b);
}

std::vector<Exceedance> exceedances_of_queries(const std::vector<QueryComparison>& queries,
                                               double tolerance) {
  std::vector<EntryComparison> lobes;
  for (const QueryComparison& query : queries)
    lobes.push_back(query.lobes);
  return exceedances(lobes, tolerance);
}

std::vector<std::string> faults_of_nodes(const DiffReport& report) {
  const Coverage& coverage = report.nodes->coverage;
  std::vector<std::string> faults;
  const auto add = [&](std::size_t count, const char* what, std::size_t first) {
    if (count > 0)
      faults.push_back(fmt::format("{} {} {}, the first is {}", count,
                                   count == 1 ? "entry" : "entries", what,
                                   entry_text(report.grid(), first)));
  };
  add(coverage.only_a, "only in A", coverage.first_only_a);
  add(coverage.only_b, "only in B", coverage.first_only_b);
  add(coverage.unjudged, "with values that cannot be judged", coverage.first_unjudged);
  return faults;
}

std::vector<std::string> faults_of_queries(const DiffReport& report) {
  const QuerySummary& use = report.use;
  std::vector<std::string> faults;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0)
      faults.push_back(fmt::format("{} {} {}", count, count == 1 ? "query" : "queries", what));
  };
  add(use.missing_a, "in need of an entry that A has not");
  add(use.missing_b, "in need of an entry that B has not");
  add(use.outside, "beyond the axes of A or B");
  add(use.singular_a, "for which A gives a matrix without an inverse");
  add(use.singular_b, "for which B gives a matrix without an inverse");
  return faults;
}

}  // namespace

NodeReport::NodeReport(const Table& a, const Table& b, std::vector<EntryComparison> compared)
    : entries(std::move(compared)),
      rows(summarize_rows(a.grid, entries)),
      coverage(coverage_of(a, b, entries)),
      losses(verdict_of_nodes(a.grid, entries)) {}

DiffReport::DiffReport(NamedTable of_a, NamedTable of_b, const DiffSettings& how,
                       std::optional<std::vector<EntryComparison>> entries,
                       std::vector<QueryComparison> compared, std::optional<double> bound)
    : a(std::move(of_a)),
      b(std::move(of_b)),
      settings(how),
      queries(std::move(compared)),
      use(summarize_queries(queries)),
      has_albedo(ltc::has_albedo(a.table) && ltc::has_albedo(b.table)),
      tolerance(bound) {
  if (entries)
    nodes.emplace(a.table, b.table, std::move(*entries));
  if (tolerance)
    exceeded = nodes ? exceedances(nodes->entries, *tolerance)
                     : exceedances_of_queries(queries, *tolerance);
}

std::vector<std::string> coverage_faults(const DiffReport& report) {
  return report.nodes ? faults_of_nodes(report) : faults_of_queries(report);
}

std::string place_text(const DiffReport& report, std::size_t index) {
  return report.nodes ? "entry " + entry_text(report.grid(), index)
                      : lobe_line(report.queries[index].lobe);
}

std::vector<WorstList> worst_lists(const DiffReport& report) {
  std::vector<WorstList> lists;
  if (!report.nodes)
    return lists;
  const auto add = [&](const std::string& name, const std::string& title, double harmless,
                       auto figure) {
    std::vector<double> values = figures_of(report.nodes->entries, figure);
    const auto worst = [&] {
      std::vector<std::size_t> entries = largest_of(values, worst_count);
      std::erase_if(entries, [&](std::size_t flat) { return !(values[flat] > harmless); });
      return entries;
    };
    lists.push_back({name, title, worst()});
    for (std::size_t flat = 0; flat < values.size(); ++flat)
      if (is_mirror(report.grid(), report.grid().node(flat).alpha))
        values[flat] = not_compared;
    std::vector<std::size_t> others = worst();
    const std::vector<std::size_t>& known = lists.back().entries;
    std::erase_if(others, [&](std::size_t flat) {
      return std::find(known.begin(), known.end(), flat) != known.end();
    });
    if (!others.empty())
      lists.push_back(
          {name + "_without_mirrors", title + ", further ones with alpha > min", others});
  };
  add("ratio", "Largest ratios", 1, [](const EntryComparison& e) { return e.ratio(); });
  add("distance", "Largest distances between the two lobes", 0,
      [](const EntryComparison& e) { return e.relative_distance(); });
  return lists;
}

std::vector<std::size_t> worst_queries(const DiffReport& report) {
  std::vector<double> behind;
  for (const QueryComparison& query : report.queries)
    behind.push_back((query.lobes.loss_a - query.lobes.loss_b) / query.lobes.spread);
  std::vector<std::size_t> worst = largest_of(behind, worst_query_count);
  std::erase_if(worst, [&](std::size_t query) { return !(behind[query] > 0); });
  return worst;
}

std::string failure_text(const DiffReport& report) {
  if (!report.tolerance)
    return "";
  const bool at_nodes = report.nodes.has_value();
  std::vector<std::string> faults;
  for (const Exceedance& exceedance : report.exceeded)
    faults.push_back(fmt::format("{} in {} {}, at most {:.4g} at {}", exceedance.figure,
                                 exceedance.entries,
                                 at_nodes ? exceedance.entries == 1 ? "entry" : "entries"
                                 : exceedance.entries == 1 ? "query"
                                                           : "queries",
                                 exceedance.largest, place_text(report, exceedance.largest_entry)));
  for (std::string& fault : coverage_faults(report))
    faults.push_back(std::move(fault));
  if (at_nodes && report.nodes->rows[0].entries == 0)
    faults.push_back("no entry that both tables have");
  if (!at_nodes && report.use.judged == 0)
    faults.push_back("no lobe that both tables serve");
  if (faults.empty())
    return "";
  return fmt::format("tolerance {} exceeded: {}", *report.tolerance, fmt::join(faults, "; "));
}

}  // namespace ltc::cli
