// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit diff: two tables judged by the same held-out samples.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/entry_text.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "core/error.h"
#include "core/platform.h"
#include "export/file.h"
#include "export/reader.h"
#include "validate/compare.h"

namespace ltc::cli {
namespace {

struct Arguments {
  std::string a, b;
  std::string csv;  // empty: none
  CompareSettings settings;
  int threads = default_threads();
};

std::string row_text(const std::string& name, const RatioSummary& ratios) {
  if (ratios.entries == 0)
    return fmt::format("{:<12} no entry that both tables have\n", name);
  return fmt::format(
      "{:<12} {:>7} {:>11.4e} {:>11.4e} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f}\n", name,
      ratios.entries, ratios.mean_loss_a, ratios.mean_loss_b, ratios.mean, ratios.p50, ratios.p95,
      ratios.p99, ratios.largest);
}

std::string csv_text(const Grid& grid, const std::vector<EntryComparison>& entries) {
  std::string text = "alpha,lambda,theta,phi,loss_a,loss_b,spread\n";
  for (std::size_t flat = 0; flat < entries.size(); ++flat)
    text += fmt::format("{},{},{},{}\n", entry_text(grid, flat), entries[flat].loss_a,
                        entries[flat].loss_b, entries[flat].spread);
  return text;
}

void diff(const Arguments& arguments) {
  ProgressDisplay progress;
  const StopOnInterrupt stop_on_interrupt(progress);
  const Table a = read_table(arguments.a), b = read_table(arguments.b);
  const std::optional<OutputFolder> folder = folder_of_file(arguments.csv);
  const std::vector<EntryComparison> entries =
      compare_tables(a, b, arguments.settings, arguments.threads, &progress);
  std::string text = fmt::format(
      "held-out sliced-Wasserstein loss of A = {} and B = {},\n{} samples, {} directions; ratio "
      "A/B\n\n",
      arguments.a, arguments.b, arguments.settings.samples, arguments.settings.directions);
  text += fmt::format("{:<12} {:>7} {:>11} {:>11} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "", "entries",
                      "mean A", "mean B", "mean", "p50", "p95", "p99", "largest");
  const RatioSummary all = summarize_ratios(entries);
  text += row_text("all", all);
  for (std::size_t alpha = 0; alpha < a.grid.alpha.size(); ++alpha) {
    std::vector<bool> in_row(entries.size());
    for (std::size_t flat = 0; flat < entries.size(); ++flat)
      in_row[flat] = a.grid.node(flat).alpha == alpha;
    text += row_text(fmt::format("alpha {:.3f}", a.grid.alpha.nodes[alpha]),
                     summarize_ratios(entries, in_row));
  }
  if (all.entries > 0)
    text += fmt::format("\nlargest ratio at entry {} ({})\n", entry_text(a.grid, all.largest_entry),
                        lobe_text(a.grid, all.largest_entry));
  if (!arguments.csv.empty())
    write_file(arguments.csv, csv_text(a.grid, entries));
  print(text);
}

}  // namespace

Action declare_diff(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  app.add_option("A", arguments->a, "table to judge, .h5 or .npy")->required();
  app.add_option("B", arguments->b, "table to judge it against, .h5 or .npy")->required();
  app.add_option("--samples", arguments->settings.samples, "held-out samples an entry")
      ->check(CLI::Range(64, 1 << 20))
      ->capture_default_str();
  app.add_option("--directions", arguments->settings.directions, "held-out directions an entry")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--seed", arguments->settings.seed, "seed of the held-out sets")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--csv", arguments->csv, "write every entry's losses to this file");
  add_threads_option(app, arguments->threads);
  return [arguments] { diff(*arguments); };
}

}  // namespace ltc::cli
