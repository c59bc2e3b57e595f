// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/diff_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>

#include "cli/fit_command.h"
#include "table/entry_text.h"

namespace ltc::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t worst_count = 5;

const Grid& grid_of(const DiffReport& report) {
  return report.a.table.grid;
}

// ---- Text ----

// One table of the report: columns of numbers, a line for every row of the comparison.
struct Section {
  std::string title;
  std::vector<std::string> header;  // lines above the numbers
  std::function<std::string(const ComparisonRow&)> line;
};

std::string mean_p95_largest(const Statistics& statistics) {
  return fmt::format(" {:>10.3e} {:>10.3e} {:>10.3e}", statistics.mean, statistics.p95,
                     statistics.largest);
}

// The header of groups of these columns.
std::vector<std::string> header_of(std::initializer_list<const char*> groups) {
  std::string above, columns;
  for (const char* group : groups) {
    above += fmt::format("  {:-^31}", fmt::format(" {} ", group));
    columns += fmt::format(" {:>10} {:>10} {:>10}", "mean", "p95", "largest");
  }
  return {above, columns};
}

Section ratio_section() {
  return {"Ratio of the losses to GGX, A over B; below 1, A is nearer",
          {fmt::format(" {:>7} {:>11} {:>11} {:>9} {:>9} {:>9} {:>9} {:>9}", "entries", "mean A",
                       "mean B", "mean", "p50", "p95", "p99", "largest")},
          [](const ComparisonRow& row) {
            const Statistics& ratio = row.ratio;
            return fmt::format(
                " {:>7} {:>11.4e} {:>11.4e} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f}",
                row.entries, row.loss_a.mean, row.loss_b.mean, ratio.mean, ratio.p50, ratio.p95,
                ratio.p99, ratio.largest);
          }};
}

Section loss_section() {
  Section section{"Losses to GGX, and how many entries of which table are nearer",
                  header_of({"A", "B"}), [](const ComparisonRow& row) {
                    return mean_p95_largest(row.loss_a) + mean_p95_largest(row.loss_b) +
                           fmt::format(" {:>9} {:>9}", row.a_nearer, row.b_nearer);
                  }};
  section.header.back() += fmt::format(" {:>9} {:>9}", "A nearer", "B nearer");
  return section;
}

std::vector<Section> sections_of(const DiffReport& report) {
  std::vector<Section> sections = {
      ratio_section(),
      loss_section(),
      {"Distance between the two lobes", header_of({"over the lobe's spread", "absolute"}),
       [](const ComparisonRow& row) {
         return mean_p95_largest(row.relative_distance) + mean_p95_largest(row.distance);
       }}};
  sections.push_back(
      {"Largest difference of a matrix entry after alignment, third columns of unit length",
       header_of({"matrix"}),
       [](const ComparisonRow& row) { return mean_p95_largest(row.matrix_difference); }});
  if (report.has_albedo)
    sections.push_back({"Differences of the integrals", header_of({"amplitude", "Fresnel"}),
                        [](const ComparisonRow& row) {
                          return mean_p95_largest(row.amplitude_difference) +
                                 mean_p95_largest(row.fresnel_difference);
                        }});
  return sections;
}

std::string section_text(const Section& section, const std::vector<ComparisonRow>& rows) {
  std::string text = fmt::format("\n{}\n", section.title);
  for (const std::string& line : section.header)
    text += fmt::format("{:<12}{}\n", "", line);
  for (const ComparisonRow& row : rows)
    text += fmt::format("{:<12}{}\n", row.name,
                        row.entries > 0 ? section.line(row) : " no entry that both tables have");
  return text;
}

// What keeps entries from being compared, one phrase each.
std::vector<std::string> coverage_faults(const DiffReport& report) {
  const Coverage& coverage = report.coverage;
  std::vector<std::string> faults;
  const auto add = [&](std::size_t count, const char* what, std::size_t first) {
    if (count > 0)
      faults.push_back(fmt::format("{} {} {}, the first is {}", count,
                                   count == 1 ? "entry" : "entries", what,
                                   entry_text(grid_of(report), first)));
  };
  add(coverage.only_a, "only in A", coverage.first_only_a);
  add(coverage.only_b, "only in B", coverage.first_only_b);
  add(coverage.unjudged, "with values that cannot be judged", coverage.first_unjudged);
  return faults;
}

std::string coverage_text(const DiffReport& report) {
  std::string text;
  for (const std::string& fault : coverage_faults(report))
    text += fault + '\n';
  if (!report.has_albedo) {
    const bool in_a = has_albedo(report.a.table), in_b = has_albedo(report.b.table);
    text += fmt::format("amplitude and Fresnel terms are not compared: {} none\n",
                        in_a   ? "B has"
                        : in_b ? "A has"
                               : "both tables have");
  }
  return text;
}

// Lists of the worst entries; what is nothing, as between equal tables, is in none.
struct WorstList {
  std::string name;   // in JSON
  std::string title;  // in text
  std::vector<std::size_t> entries;
};

// By ratio and by distance; where mirrors take places, those that they displaced as well.
std::vector<WorstList> worst_lists(const DiffReport& report) {
  const Grid& grid = grid_of(report);
  std::vector<WorstList> lists;
  const auto add = [&](const std::string& name, const std::string& title, double harmless,
                       auto figure) {
    std::vector<double> values = figures_of(report.entries, figure);
    const auto worst = [&] {
      std::vector<std::size_t> entries = largest_of(values, worst_count);
      std::erase_if(entries, [&](std::size_t flat) { return !(values[flat] > harmless); });
      return entries;
    };
    lists.push_back({name, title, worst()});
    for (std::size_t flat = 0; flat < values.size(); ++flat)
      if (is_mirror(grid, grid.node(flat).alpha))
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

std::string worst_text(const DiffReport& report, const WorstList& list) {
  if (list.entries.empty())
    return "";
  std::string text = fmt::format("\n{}\n", list.title);
  for (const std::size_t flat : list.entries) {
    const EntryComparison& entry = report.entries[flat];
    text += fmt::format(
        "{} ({})\n    ratio {:.4f}: loss {:.3e} of A, {:.3e} of B; lobes {:.3g} % of the spread "
        "apart\n    A: {}\n    B: {}\n",
        entry_text(grid_of(report), flat), lobe_text(grid_of(report), flat), entry.ratio(),
        entry.loss_a, entry.loss_b, 100 * entry.relative_distance(),
        EntryCommands(report.a.file, report.a.table).best(flat),
        EntryCommands(report.b.file, report.b.table).best(flat));
  }
  return text;
}

std::string tolerance_text(const DiffReport& report) {
  if (!report.tolerance)
    return "";
  const std::string failure = failure_text(report);
  return failure.empty() ? fmt::format("\ntolerance {}: passed\n", *report.tolerance)
                         : fmt::format("\n{}\n", failure);
}

// ---- JSON ----

Json json_of(const Grid& grid, const Statistics& statistics) {
  if (statistics.count == 0)
    return nullptr;
  return {{"mean", statistics.mean},
          {"p50", statistics.p50},
          {"p95", statistics.p95},
          {"p99", statistics.p99},
          {"largest", statistics.largest},
          {"largest_entry", entry_text(grid, statistics.largest_index)}};
}

Json json_of(const Grid& grid, const ComparisonRow& row) {
  return {{"name", row.name},
          {"entries", row.entries},
          {"a_nearer", row.a_nearer},
          {"b_nearer", row.b_nearer},
          {"loss_a", json_of(grid, row.loss_a)},
          {"loss_b", json_of(grid, row.loss_b)},
          {"ratio", json_of(grid, row.ratio)},
          {"relative_distance", json_of(grid, row.relative_distance)},
          {"distance", json_of(grid, row.distance)},
          {"matrix_difference", json_of(grid, row.matrix_difference)},
          {"amplitude_difference", json_of(grid, row.amplitude_difference)},
          {"fresnel_difference", json_of(grid, row.fresnel_difference)}};
}

// The name of a figure in JSON and CSV, and its value.
struct Field {
  const char* name;
  double value;
};
std::array<Field, 7> fields_of(const EntryComparison& entry) {
  return {{{"loss_a", entry.loss_a},
           {"loss_b", entry.loss_b},
           {"spread", entry.spread},
           {"distance", entry.distance},
           {"matrix_difference", entry.matrix_difference},
           {"amplitude_difference", entry.amplitude_difference},
           {"fresnel_difference", entry.fresnel_difference}}};
}

Json json_of_entry(const DiffReport& report, std::size_t flat) {
  Json json = {{"entry", entry_text(grid_of(report), flat)}};
  for (const auto& [name, value] : fields_of(report.entries[flat]))
    json[name] = value;  // null for NaN
  return json;
}

Json json_of_worst(const DiffReport& report, const std::vector<std::size_t>& worst) {
  Json all = Json::array();
  for (const std::size_t flat : worst) {
    Json json = json_of_entry(report, flat);
    json["ratio"] = report.entries[flat].ratio();
    json["relative_distance"] = report.entries[flat].relative_distance();
    json["command_a"] = EntryCommands(report.a.file, report.a.table).best(flat);
    json["command_b"] = EntryCommands(report.b.file, report.b.table).best(flat);
    all.push_back(json);
  }
  return all;
}

Json json_of_tolerance(const DiffReport& report) {
  if (!report.tolerance)
    return nullptr;
  const std::string failure = failure_text(report);
  Json exceeded = Json::array();
  for (const Exceedance& exceedance : report.exceeded)
    exceeded.push_back({{"figure", exceedance.figure},
                        {"entries", exceedance.entries},
                        {"largest", exceedance.largest},
                        {"largest_entry", entry_text(grid_of(report), exceedance.largest_entry)}});
  return {{"value", *report.tolerance}, {"passed", failure.empty()}, {"exceeded", exceeded}};
}

}  // namespace

DiffReport::DiffReport(NamedTable of_a, NamedTable of_b, const CompareSettings& how,
                       std::vector<EntryComparison> compared, std::optional<double> bound)
    : a(std::move(of_a)),
      b(std::move(of_b)),
      settings(how),
      entries(std::move(compared)),
      rows(summarize_rows(a.table.grid, entries)),
      coverage(coverage_of(a.table, b.table, entries)),
      has_albedo(ltc::has_albedo(a.table) && ltc::has_albedo(b.table)),
      tolerance(bound) {
  if (tolerance)
    exceeded = exceedances(entries, *tolerance);
}

std::string report_text(const DiffReport& report) {
  const auto shape = grid_of(report).shape();
  std::string text = fmt::format(
      "A = {}\nB = {}\n{} of {} entries ({}x{}x{}x{}) compared; held out: {} samples, {} "
      "directions\n",
      report.a.file, report.b.file, report.rows[0].entries, report.entries.size(), shape[0],
      shape[1], shape[2], shape[3], report.settings.samples, report.settings.directions);
  text += coverage_text(report);
  for (const Section& section : sections_of(report))
    text += section_text(section, report.rows);
  for (const WorstList& list : worst_lists(report))
    text += worst_text(report, list);
  return text + tolerance_text(report);
}

std::string report_json(const DiffReport& report) {
  Json json;
  json["a"] = report.a.file;
  json["b"] = report.b.file;
  json["samples"] = report.settings.samples;
  json["directions"] = report.settings.directions;
  json["seed"] = report.settings.seed;
  json["shape"] = grid_of(report).shape();
  json["compared"] = report.rows[0].entries;
  json["only_a"] = report.coverage.only_a;
  json["only_b"] = report.coverage.only_b;
  json["unjudged"] = report.coverage.unjudged;
  json["tolerance"] = json_of_tolerance(report);
  json["rows"] = Json::array();
  for (const ComparisonRow& row : report.rows)
    json["rows"].push_back(json_of(grid_of(report), row));
  for (const WorstList& list : worst_lists(report))
    json["worst"][list.name] = json_of_worst(report, list.entries);
  json["entries"] = Json::array();
  for (std::size_t flat = 0; flat < report.entries.size(); ++flat)
    json["entries"].push_back(json_of_entry(report, flat));
  // File names are bytes of any kind; JSON is UTF-8.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_csv(const DiffReport& report) {
  std::string text = "alpha,lambda,theta,phi";
  for (const Field& field : fields_of({}))
    text += fmt::format(",{}", field.name);
  for (std::size_t flat = 0; flat < report.entries.size(); ++flat) {
    text += '\n' + entry_text(grid_of(report), flat);
    for (const Field& field : fields_of(report.entries[flat]))
      text += fmt::format(",{}", field.value);
  }
  return text + '\n';
}

std::string failure_text(const DiffReport& report) {
  if (!report.tolerance)
    return "";
  std::vector<std::string> faults;
  for (const Exceedance& exceedance : report.exceeded)
    faults.push_back(fmt::format("{} in {} {}, at most {:.4g} at entry {}", exceedance.figure,
                                 exceedance.entries, exceedance.entries == 1 ? "entry" : "entries",
                                 exceedance.largest,
                                 entry_text(grid_of(report), exceedance.largest_entry)));
  for (std::string& fault : coverage_faults(report))
    faults.push_back(std::move(fault));
  if (report.rows[0].entries == 0)
    faults.push_back("no entry that both tables have");
  if (faults.empty())
    return "";
  return fmt::format("tolerance {} exceeded: {}", *report.tolerance, fmt::join(faults, "; "));
}

}  // namespace ltc::cli
