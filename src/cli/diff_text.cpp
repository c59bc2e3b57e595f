// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The text of diff.
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "brdf/lobe_model.h"
#include "cli/diff_report.h"
#include "cli/fit_command.h"
#include "cli/lobe_words.h"
#include "judge/quality_summary.h"
#include "table/entry_text.h"

namespace ltc::cli {
namespace {

// ---- What is compared, and which table is nearer ----

std::string nodes_judged_text(const DiffReport& report) {
  if (!report.nodes)
    return fmt::format(
        "nodes are not compared: the tables have different grids ({} and {}{}); only use is "
        "judged\n",
        shape_text(report.grid()), shape_text(report.b.table.grid),
        report.grid().shape() == report.b.table.grid.shape() ? ", with other axes" : "");
  return fmt::format("{} of {} entries ({}) compared; held out: {} samples, {} directions\n",
                     report.nodes->rows[0].entries, report.nodes->entries.size(),
                     shape_text(report.grid()), report.settings.nodes.samples,
                     report.settings.nodes.directions);
}

std::string queries_judged_text(const DiffReport& report) {
  const QualitySettings& settings = report.settings.use;
  if (report.queries.empty())
    return "use is not judged: no queries between the nodes\n";
  return fmt::format(
      "{} of {} queries between the nodes compared; {} samples, {} directions, {} area lights\n",
      report.use.judged, report.queries.size(), settings.query_samples, settings.query_directions,
      settings.quads);
}

// "A (0.0812 against 0.1120)".
std::string nearer_text(const Verdict& verdict) {
  const int sign = verdict.sign();
  return fmt::format("{} ({:.4f} against {:.4f})",
                     sign < 0   ? "A"
                     : sign > 0 ? "B"
                                : "alike",
                     verdict.a.mean, verdict.b.mean);
}

std::string verdict_text(const DiffReport& report) {
  std::vector<std::string> parts;
  if (report.use.look_ups.difference.count > 0)
    parts.push_back("in use " + nearer_text(report.use.look_ups));
  if (report.use.area_lights.difference.count > 0)
    parts.push_back("under area lights " + nearer_text(report.use.area_lights));
  if (report.nodes && report.nodes->losses.difference.count > 0)
    parts.push_back(fmt::format("at nodes{} {}",
                                has_mirrors_and_others(report.grid()) ? " of alpha > min" : "",
                                nearer_text(report.nodes->losses)));
  return parts.empty() ? ""
                       : fmt::format("nearer to {}: {}\n", report.grid().model->label(),
                                     fmt::join(parts, ", "));
}

// At its nodes a refined table is worse on purpose.
std::string refined_text(const DiffReport& report) {
  const bool a = report.a.table.refined == true, b = report.b.table.refined == true;
  if (!a && !b)
    return "";
  return fmt::format(
      "{} refined: nodes of a refined table serve what lies between them and are no fits of their "
      "own lobes; go by use\n",
      a && b ? "A and B are"
      : a    ? "A is"
             : "B is");
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

// ---- Use ----

std::string verdict_row(const char* name, const Verdict& verdict) {
  if (verdict.difference.count == 0)
    return "";
  return fmt::format(
      "{:<28} {:>8.4f} {:>8.4f} {:>8.4f} {:>8.4f} {:>8.4f} {:>8.4f} {:>9} {:>9} {:>9.4f} "
      "{:>7.4f}\n",
      name, verdict.a.mean, verdict.a.p95, verdict.a.largest, verdict.b.mean, verdict.b.p95,
      verdict.b.largest, verdict.a_nearer, verdict.b_nearer, verdict.difference.mean,
      verdict.difference.standard_error);
}

std::string distance_row(const char* name, const Statistics& statistics) {
  if (statistics.count == 0)
    return "";
  return fmt::format("{:<28} {:>10.3e} {:>10.3e} {:>10.3e}\n", name, statistics.mean,
                     statistics.p95, statistics.largest);
}

std::string use_text(const DiffReport& report) {
  const QuerySummary& use = report.use;
  if (use.judged == 0)
    return "";
  std::string text = fmt::format(
      "\nIn use: errors of look-ups between the nodes\n"
      "{:<28} {:-^26} {:-^26}\n"
      "{:<28} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9} {:>9} {:>7}\n",
      "", " A ", " B ", "", "mean", "p95", "largest", "mean", "p95", "largest", "A nearer",
      "B nearer", "A - B", "+-");
  text += verdict_row("loss over the lobe's spread", use.look_ups);
  text += verdict_row("area lights, shape alone", use.area_lights);
  text += verdict_row("  with the table's amplitude", use.area_lights_with_amplitude);
  text += fmt::format("\n{:<28} {:>10} {:>10} {:>10}\n", "Between the two look-ups", "mean", "p95",
                      "largest");
  text += distance_row("lobes, over the spread", use.relative_distance);
  text += distance_row("amplitude", use.amplitude_difference);
  text += distance_row("Fresnel term", use.fresnel_difference);
  return text;
}

std::string worst_queries_text(const DiffReport& report) {
  std::string text;
  for (const std::size_t i : worst_queries(report)) {
    const QueryComparison& query = report.queries[i];
    text += fmt::format(
        "{}\n    loss {:.4f} of A, {:.4f} of B, over the spread; area lights {:.4f} and {:.4f}\n"
        "    A: {}\n    B: {}\n",
        lobe_line(query.lobe), query.lobes.loss_a / query.lobes.spread,
        query.lobes.loss_b / query.lobes.spread, query.area_light_a, query.area_light_b,
        query_command(report.a.file, query.lobe), query_command(report.b.file, query.lobe));
  }
  return text.empty() ? "" : "\nLook-ups of A furthest behind those of B\n" + text;
}

// ---- Nodes ----

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

std::string worst_text(const DiffReport& report, const WorstList& list) {
  if (list.entries.empty())
    return "";
  std::string text = fmt::format("\n{}\n", list.title);
  for (const std::size_t flat : list.entries) {
    const EntryComparison& entry = report.nodes->entries[flat];
    text += fmt::format(
        "{} ({})\n    ratio {:.4f}: loss {:.3e} of A, {:.3e} of B; lobes {:.3g} % of the spread "
        "apart\n    A: {}\n    B: {}\n",
        entry_text(report.grid(), flat), lobe_text(report.grid(), flat), entry.ratio(),
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

}  // namespace

std::string report_text(const DiffReport& report) {
  std::string text = fmt::format("A = {}\nB = {}\n", report.a.file, report.b.file);
  text += nodes_judged_text(report) + queries_judged_text(report) + coverage_text(report);
  text +=
      refined_text(report) + verdict_text(report) + use_text(report) + worst_queries_text(report);
  if (report.nodes)
    for (const Section& section : sections_of(report))
      text += section_text(section, report.nodes->rows);
  for (const WorstList& list : worst_lists(report))
    text += worst_text(report, list);
  return text + tolerance_text(report);
}

}  // namespace ltc::cli
