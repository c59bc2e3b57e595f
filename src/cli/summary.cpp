// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/summary.h"

#include <fmt/format.h>

#include "cli/lobe_words.h"
#include "cli/progress.h"
#include "core/angle.h"
#include "pipeline/summary.h"
#include "table/entry_text.h"
#include "table/reduction.h"

namespace ltc::cli {
namespace {

std::string time_text(const RunReport& report) {
  std::string stages;
  for (const auto& [stage, seconds] : report.generate.stage_seconds)
    stages += fmt::format("{}{} {}", stages.empty() ? "" : ", ", stage, duration_text(seconds));
  return fmt::format("time     {} ({})\n", duration_text(report.seconds), stages);
}

std::string entries_text(const TableSummary& summary) {
  const auto count = [&](Status status) {
    return summary.entries_by_status[static_cast<std::size_t>(status)];
  };
  std::size_t all = 0;
  for (const std::size_t entries : summary.entries_by_status)
    all += entries;
  const std::size_t between = count(Status::interpolated);
  return fmt::format(
      "entries  {}: {} fitted, {}{} copied by symmetry, {} analytic, {} skipped, {} failed\n", all,
      count(Status::fitted), between > 0 ? fmt::format("{} interpolated, ", between) : "",
      count(Status::copied), count(Status::analytic), count(Status::skipped),
      count(Status::failed));
}

std::string loss_text(const TableSummary& summary) {
  if (summary.losses.count == 0)
    return "loss     no entry has one\n";
  return fmt::format("loss     mean {:.4e}, p95 {:.4e}, largest {:.4e} (sliced Wasserstein)\n",
                     summary.losses.mean, summary.losses.p95, summary.losses.largest);
}

// What a scene, a table to extend and a checkpoint have spared; nothing where there was none.
std::string scene_text(const RunReport& report) {
  std::string text;
  const std::size_t entries = report.table.grid.size();
  if (report.needed < entries)
    text += fmt::format("scene    {} of {} entries needed\n", report.needed, entries);
  if (report.extends)
    text += fmt::format("extended {} entries added, the others kept\n", report.added);
  if (report.resumed > 0)
    text += fmt::format("resumed  {} fits taken from the checkpoint\n", report.resumed);
  const GenerateReport& made = report.generate;
  const double seconds = made.stage_seconds.empty() ? 0 : made.stage_seconds.front().second;
  if (report.resumed == 0 && made.fits > 0 && made.fits < made.fits_of_whole_grid)
    text += fmt::format(
        "saved    about {}: {} lobes fitted instead of {}\n",
        duration_text(seconds * static_cast<double>(made.fits_of_whole_grid - made.fits) /
                      static_cast<double>(made.fits)),
        made.fits, made.fits_of_whole_grid);
  return text;
}

// Which part of the config's range was refined on; nothing where it was all of it.
std::string range_text(const GenerateReport& made) {
  if (!made.range_served)
    return "";
  return fmt::format("         on what the table serves: {}\n", range_words(*made.range_served));
}

// One node along phi is enough for isotropic lobes alone.
std::string azimuth_text(const Grid& grid) {
  if (grid.phi.size() > 1 || Reduction(grid).turns())
    return "";
  return fmt::format(
      "warning  one node along phi, and lobes that are not isotropic: right for views along phi = "
      "{:.4g} alone; others get the values there\n",
      grid.phi.first() / radians_per_degree);
}

// What refinement has gained; nothing where none was asked for.
std::string refine_text(const GenerateReport& made) {
  if (!made.refine)
    return "";
  const RefineReport& report = *made.refine;
  if (!report.kept)
    return fmt::format(
        "refined  not: {} steps over {} queries did not better {:.4f}, the mean relative loss of "
        "held-out queries\n",
        report.steps, report.queries, report.loss_before);
  return fmt::format(
      "refined  {} steps over {} queries: mean relative loss of held-out queries {:.4f}, at its "
      "start {:.4f}\n",
      report.steps, report.queries, report.loss_after, report.loss_before);
}

std::string field_text(const RunReport& report) {
  if (!report.generate.field)
    return "";
  const FieldReport& made = *report.generate.field;
  const auto& terms = report.table.field->terms;
  const auto of_matrix = static_cast<std::size_t>(
      std::ranges::count_if(terms, [](const FieldTerm& t) { return !is_of_albedo(t.part); }));
  return fmt::format(
      "field    {} numbers for the matrix, of {}, and {} for the albedo; {} steps over {} queries\n"
      "         mean relative loss of held-out queries {:.4f}\n"
      "         amplitude off by {:.1e} in the mean, {:.1e} at most, Fresnel term {:.1e}, {:.1e}\n",
      of_matrix, made.pool, terms.size() - of_matrix, made.steps, made.queries, made.loss,
      made.amplitude_error, made.amplitude_error_most, made.fresnel_error, made.fresnel_error_most);
}

std::string worst_text(const Table& table, const TableSummary& summary,
                       const SummaryCommands& commands) {
  std::string text;
  const auto add = [&](const char* what, const std::string& command, std::size_t flat) {
    if (!command.empty())
      text += fmt::format("           {}{} {}\n", what, command, entry_text(table.grid, flat));
  };
  const bool both = !commands.fit.empty() && !commands.stored.empty();
  for (const std::size_t flat : summary.worst) {
    text += fmt::format("{} {:.4e}  {}\n", text.empty() ? "worst   " : "        ",
                        table.sw_loss[flat], lobe_text(table.grid, flat));
    add(both ? "in the table:      " : "", commands.stored, flat);
    add(both ? "before refinement: " : "", commands.fit, flat);
  }
  return text;
}

}  // namespace

std::string summary_text(const RunReport& report, const SummaryCommands& commands) {
  const Table& table = report.table;
  const TableSummary summary = summarize(table, worst_count);
  std::string text = time_text(report);
  text += fmt::format("memory   {:.0f} MB at most\n",
                      static_cast<double>(report.peak_memory_bytes) / 1e6);
  text += entries_text(summary);
  text += scene_text(report);
  text += refine_text(report.generate) + range_text(report.generate) + field_text(report);
  text += azimuth_text(table.grid);
  text += loss_text(summary);
  text += fmt::format("symmetry largest value zeroed {:.1e}, at entry {}\n",
                      report.generate.largest_zeroed,
                      entry_text(table.grid, report.generate.largest_zeroed_entry));
  text += worst_text(table, summary, commands);
  if (!report.half.empty())
    text += fmt::format("half     {}\n", report.half);
  for (const auto& [format, why] : report.left_out)
    text += fmt::format("{:<8} it {}\n", "no " + format, why);
  for (const std::filesystem::path& file : report.files)
    text += fmt::format("wrote    {}\n", file.string());
  for (const std::filesystem::path& file : report.removed)
    text += fmt::format("removed  {}: of an older table\n", file.string());
  return text;
}

}  // namespace ltc::cli
