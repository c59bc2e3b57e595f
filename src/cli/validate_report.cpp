// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/validate_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/fit_command.h"
#include "cli/quality_report.h"
#include "fit/symmetry_plan.h"
#include "table/entry_text.h"

namespace ltc::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_shown = 5;  // entries of a failed check on the terminal

std::string table_text(const Validation& report) {
  const Grid& grid = report.table.grid;
  const auto skipped =
      std::count(report.table.status.begin(), report.table.status.end(), Status::skipped);
  return fmt::format("{}: {} entries, storage {}, {} skipped\n{}\n\n", report.file,
                     shape_text(grid), name_of(report.table.storage), skipped,
                     kind_text(report.table));
}

std::string verdict_text(const InvariantResult& result) {
  return !result.passed ? "FAILED" : result.judged ? "passed" : "not judged";
}

std::string row_text(const Grid& grid, const InvariantResult& result) {
  if (!result.checked)
    return fmt::format("{:<20} {:>12}  not checked: {}\n", result.name, "", result.reason);
  if (!result.has_worst)
    return fmt::format("{:<20} {:>12}  {:<16} {}\n", result.name, "", "", verdict_text(result));
  // Where all entries have the least value there is, none is worst.
  const bool none_is_worst = result.passed && result.value == 0;
  const std::string where = none_is_worst ? ""
                                          : fmt::format("{} ({})", entry_text(grid, result.worst),
                                                        lobe_text(grid, result.worst));
  return fmt::format("{:<20} {:>12.4g}  {:<16} {:<10} {}\n", result.name, result.value,
                     allowed_text(result), verdict_text(result), where);
}

// What the table holds there, and what its config makes of the entry.
std::string commands_text(const EntryCommands& commands, std::size_t flat) {
  std::string text = fmt::format("    {:<19}{}\n", "in the table:", commands.stored(flat));
  if (const std::string fitted = commands.fitted(flat); !fitted.empty())
    text += fmt::format("    {:<19}{}\n",
                        commands.refined() ? "before refinement:" : "fitted anew:", fitted);
  return text;
}

std::string failed_text(const Validation& report, const InvariantResult& result,
                        const EntryCommands& commands) {
  if (result.entries.empty())
    return fmt::format("\n{}: {}\n", result.name, result.message);
  std::string text =
      fmt::format("\n{} fails at {} {}, worst first:\n", result.name, result.entries.size(),
                  result.entries.size() == 1 ? "entry" : "entries");
  std::vector<std::size_t> shown = each_lobe_once(report.table.grid, result.entries);
  shown.resize(std::min(shown.size(), most_shown));
  for (const std::size_t flat : shown)
    text += fmt::format("  {} ({})\n{}", entry_text(report.table.grid, flat),
                        lobe_text(report.table.grid, flat), commands_text(commands, flat));
  if (shown.size() < result.entries.size())
    text += fmt::format("  and {} more; --json lists all\n", result.entries.size() - shown.size());
  return text;
}

Json entry_json(const Validation& report, std::size_t flat, const EntryCommands& commands) {
  const Grid& grid = report.table.grid;
  Json json = {{"entry", entry_text(grid, flat)},
               {"lobe", lobe_text(grid, flat)},
               {"command", commands.stored(flat)}};
  if (const std::string fitted = commands.fitted(flat); !fitted.empty())
    json["fit_command"] = fitted;
  return json;
}

Json invariant_json(const Validation& report, const InvariantResult& result,
                    const EntryCommands& commands) {
  Json json;
  json["name"] = result.name;
  json["checked"] = result.checked;
  json["judged"] = result.checked && result.judged;
  json["passed"] = result.checked ? Json(result.passed) : Json(nullptr);
  json["reason"] = result.reason;
  if (result.checked && result.has_worst) {
    json["value"] = result.value;  // null where it is not finite
    json["worst"] = entry_json(report, result.worst, commands);
  }
  json[result.at_most ? "at_most" : "above"] = result.limit;
  json["message"] = result.message;
  json["failed_entries"] = Json::array();
  for (const std::size_t flat : result.entries)
    json["failed_entries"].push_back(entry_json(report, flat, commands));
  return json;
}

}  // namespace

std::string report_text(const Validation& report) {
  const EntryCommands commands(report.file, report.table);
  std::string text = table_text(report);
  if (!report.invariants.empty())
    text += fmt::format("{:<20} {:>12}  {:<16} {:<10} {}\n", "check", "worst", "allowed", "",
                        "at entry");
  for (const InvariantResult& result : report.invariants)
    text += row_text(report.table.grid, result);
  for (const InvariantResult& result : report.invariants)
    if (!result.passed)
      text += failed_text(report, result, commands);
  if (report.quality)
    text += quality_text(report.file, *report.quality, report.thresholds);
  return text;
}

std::string report_json(const Validation& report) {
  const EntryCommands commands(report.file, report.table);
  Json json;
  json["table"] = report.file;
  json["passed"] = failure_text(report).empty();
  json["refined"] = report.table.refined ? Json(*report.table.refined) : Json(nullptr);
  json["bits"] = report.table.precision == Precision::half ? 16 : 32;
  json["invariants"] = Json::array();
  for (const InvariantResult& result : report.invariants)
    json["invariants"].push_back(invariant_json(report, result, commands));
  if (report.quality)
    json["quality"] = quality_json(report.file, *report.quality, report.thresholds);
  // File names are bytes of any kind; JSON is UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string failure_text(const Validation& report) {
  std::string text, others;
  for (const InvariantResult& result : report.invariants) {
    if (result.passed)
      continue;
    if (text.empty())
      text = report.file + ": " + result.message;
    else
      others += (others.empty() ? "; failed too: " : ", ") + result.name;
  }
  for (const ThresholdCheck& check : report.thresholds) {
    if (check.passed)
      continue;
    if (text.empty())
      text = report.file + ": " + failure_line(check);
    else
      others += (others.empty() ? "; failed too: " : ", ") + check.key;
  }
  return text + others;
}

}  // namespace ltc::cli
