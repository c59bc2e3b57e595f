// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit diff: two tables judged by the same held-out samples.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/diff_report.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/table_input.h"
#include "core/error.h"
#include "core/write_file.h"
#include "validate/ratio_map.h"

namespace ltc::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string a, b;
  std::optional<Layout> layout;
  std::string csv, json, map;  // empty: none
  std::optional<double> tolerance;
  CompareSettings settings;
  std::size_t queries = QualitySettings().queries;
  int threads = default_threads();
};

// The files to write can be written: better known now than after the comparison. Their folders are
// created if need be, and removed again if nothing comes to lie in them.
std::deque<OutputFolder> prepare_outputs(const Arguments& arguments) {
  std::deque<OutputFolder> folders;  // which cannot move
  std::error_code ignored;
  for (const fs::path file : {arguments.csv, arguments.json, arguments.map}) {
    if (file.empty())
      continue;
    if (fs::is_directory(file, ignored))
      throw IoError(fmt::format("cannot write {}: it is a folder", file.string()));
    folders.emplace_back(file.has_parent_path() ? file.parent_path() : ".");
  }
  return folders;
}

// Tables of different grids have no nodes to compare: what asks for them is refused.
void require_comparable(const NamedTable& a, const NamedTable& b, const Arguments& arguments,
                        bool any_queries) {
  if (a.table.grid == b.table.grid || (any_queries && arguments.map.empty()))
    return;
  try {
    require_same_grid(a.table.grid, b.table.grid);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} and {}: {}{}", a.file, b.file, error.what(),
                                 any_queries              ? ", as --map does"
                                 : arguments.queries == 0 ? "; expected --queries above 0"
                                                          : ", and they serve no lobe in common"));
  }
}

// The settings, with the queries that both tables serve; none where there are none.
DiffSettings settings_for(const Arguments& arguments, const Table& a, const Table& b) {
  DiffSettings settings{arguments.settings, {}};
  QualitySettings& use = settings.use;
  const std::optional<QueryRange> range = common_range(a.grid, b.grid);
  use.queries = range ? arguments.queries : 0;
  use.range = range.value_or(use.range);
  use.query_samples = arguments.settings.samples;
  use.query_directions = std::min(use.query_directions, arguments.settings.directions);
  use.seed = arguments.settings.seed;
  return settings;
}

DiffReport compare(const Arguments& arguments, NamedTable a, NamedTable b,
                   const DiffSettings& settings, Progress& progress) {
  std::optional<std::vector<EntryComparison>> entries;
  if (a.table.grid == b.table.grid)
    entries = compare_tables(a.table, b.table, settings.nodes, arguments.threads, &progress);
  std::vector<QueryComparison> queries =
      compare_queries(a.table, b.table, settings.use, arguments.threads, &progress);
  return DiffReport(std::move(a), std::move(b), settings, std::move(entries), std::move(queries),
                    arguments.tolerance);
}

void diff(const Arguments& arguments) {
  ProgressDisplay progress;
  const StopOnInterrupt stop_on_interrupt(progress);
  NamedTable a{arguments.a, read_input(arguments.a, arguments.layout)},
      b{arguments.b, read_input(arguments.b, arguments.layout)};
  const DiffSettings settings = settings_for(arguments, a.table, b.table);
  require_comparable(a, b, arguments, settings.use.queries > 0);
  const std::deque<OutputFolder> folders = prepare_outputs(arguments);
  const DiffReport report = compare(arguments, std::move(a), std::move(b), settings, progress);
  if (!arguments.csv.empty())
    write_file(arguments.csv, report_csv(report));
  if (!arguments.json.empty())
    write_file(arguments.json, report_json(report));
  if (!arguments.map.empty())
    picture::render(ratio_map(report.grid(), report.nodes->entries, report.a.file, report.b.file))
        .write_png(arguments.map);
  print(report_text(report));
  if (const std::string failure = failure_text(report); !failure.empty())
    throw CheckFailure(failure);
}

// A message if the text is no tolerance; NaN would be one that nothing exceeds.
std::string check_tolerance(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && stop == end && std::isfinite(value) && value >= 0)
    return "";
  return shell_quoted(text) + " is not allowed; expected a number, 0 or more";
}

void add_judge_options(CLI::App& app, Arguments& arguments) {
  CompareSettings& settings = arguments.settings;
  constexpr const char* group = "How to judge";
  app.add_option("--queries", arguments.queries,
                 fmt::format("look-ups between the nodes, the same in both tables; 0: none [{}]",
                             arguments.queries))
      ->check(CLI::Range(0, 1 << 20))
      ->option_text("N")
      ->group(group);
  app.add_option("--samples", settings.samples,
                 fmt::format("held-out samples a lobe [{}]", settings.samples))
      ->check(CLI::Range(64, 1 << 20))
      ->option_text("N")
      ->group(group);
  app.add_option("--directions", settings.directions,
                 fmt::format("held-out directions an entry; a look-up at most {} of them [{}]",
                             QualitySettings().query_directions, settings.directions))
      ->check(CLI::Range(1, 4096))
      ->option_text("N")
      ->group(group);
  app.add_option("--seed", settings.seed,
                 fmt::format("seed of the held-out sets [{}]", settings.seed))
      ->check(CLI::NonNegativeNumber)
      ->option_text("N")
      ->group(group);
}

void add_output_options(CLI::App& app, Arguments& arguments) {
  constexpr const char* group = "What to write";
  add_png_option(app, "--map", arguments.map,
                 "draw the ratio of the losses over the whole table into this file")
      ->group(group);
  app.add_option("--csv", arguments.csv,
                 "write the figures of every entry and look-up to this file [none]")
      ->option_text("FILE")
      ->group(group);
  app.add_option("--json", arguments.json, "write the whole report to this file [none]")
      ->option_text("FILE")
      ->group(group);
}

}  // namespace

Action declare_diff(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  app.add_option("A", arguments->a, "table to judge, .h5, .npy or .0.exr")
      ->required()
      ->option_text(" ");
  app.add_option("B", arguments->b, "table to judge it against, .h5, .npy or .0.exr")
      ->required()
      ->option_text(" ");
  add_layout_option(app, arguments->layout);
  app.add_option(
         "--tolerance", arguments->tolerance,
         "exit with 1 where the lobes of an entry are farther apart than this share of "
         "their spread, or amplitude or Fresnel term differ by more; of a look-up where the "
         "grids differ [none]")
      ->check(check_tolerance)
      ->option_text("X")
      ->group("What to check");
  add_judge_options(app, *arguments);
  add_output_options(app, *arguments);
  add_threads_option(app, arguments->threads);
  return [arguments] { diff(*arguments); };
}

}  // namespace ltc::cli
