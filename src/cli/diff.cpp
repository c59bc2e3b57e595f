// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit diff: two tables judged by the same held-out samples.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
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
#include "core/parallel.h"
#include "core/write_file.h"
#include "report/ratio_map.h"

namespace ltc::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string a, b;
  std::optional<ReadAs> layout;
  std::string csv, json, map;  // empty: none
  std::optional<double> tolerance;
  CompareSettings settings;
  std::size_t queries = QualitySettings().queries;
  int threads = processor_count();
};

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
                   const DiffSettings& settings, const RunContext& run) {
  std::optional<std::vector<EntryComparison>> entries;
  // The nodes of a field are as good as any other lobes.
  if (a.table.grid == b.table.grid && !a.table.field && !b.table.field)
    entries = compare_tables(a.table, b.table, settings.nodes, run);
  std::vector<QueryComparison> queries = compare_queries(a.table, b.table, settings.use, run);
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
  const DiffReport report =
      compare(arguments, std::move(a), std::move(b), settings, {arguments.threads, &progress});
  if (!arguments.csv.empty())
    write_file(arguments.csv, report_csv(report));
  if (!arguments.map.empty())
    picture::render(ratio_map(report.grid(), report.nodes->entries, report.a.file, report.b.file))
        .write_png(arguments.map);
  print_results(
      arguments.json, [&] { return report_text(report); }, [&] { return report_json(report); });
  if (const std::string failure = failure_text(report); !failure.empty())
    throw CheckFailure(failure);
}

void add_judge_options(CLI::App& app, Arguments& arguments) {
  CompareSettings& settings = arguments.settings;
  const auto add = [&](const char* name, auto& value, const std::string& what, Allowed allowed) {
    allow(app.add_option(name, value, fmt::format("{} [{}]", what, value)), std::move(allowed))
        ->option_text("N")
        ->group("How to judge");
  };
  add("--queries", arguments.queries,
      "look-ups between the nodes, the same in both tables; 0: none", whole_number(0, 1 << 20));
  add("--samples", settings.samples, "held-out samples a lobe", whole_number(64, 1 << 20));
  add("--directions", settings.directions,
      fmt::format("held-out directions an entry; a look-up at most {} of them",
                  QualitySettings().query_directions),
      whole_number(1, 4096));
  add("--seed", settings.seed, "seed of the held-out sets", seed_number());
}

void add_output_options(CLI::App& app, Arguments& arguments) {
  constexpr const char* group = "What to write";
  add_png_option(app, "--map", arguments.map,
                 "draw the ratio of the losses over the whole table into this file")
      ->group(group);
  add_output_option(app, "--csv", arguments.csv,
                    "write the figures of every entry and look-up to this file")
      ->group(group);
  add_json_option(app, arguments.json)->group(group);
}

}  // namespace

Action declare_diff(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_table_argument(app, "A", arguments->a, "table to judge");
  add_table_argument(app, "B", arguments->b, "table to judge it against");
  add_layout_option(app, arguments->layout);
  Allowed tolerance = number({0, std::numeric_limits<double>::max()});
  tolerance.expected = "a number, 0 or more";
  allow(app.add_option(
            "--tolerance", arguments->tolerance,
            "exit with 1 where the lobes of an entry are farther apart than this share of "
            "their spread, or amplitude or Fresnel term differ by more; of a look-up where the "
            "grids differ [none]"),
        std::move(tolerance))
      ->option_text("X")
      ->group("What to check");
  add_judge_options(app, *arguments);
  add_output_options(app, *arguments);
  add_threads_option(app, arguments->threads);
  return [arguments](Files&) { diff(*arguments); };
}

}  // namespace ltc::cli
