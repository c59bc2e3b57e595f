// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit validate: whether a table is sound, and how good it is.
#include <memory>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/lobe_words.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/table_input.h"
#include "cli/validate_report.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/write_file.h"
#include "export/table_file.h"
#include "judge/validate_settings.h"
#include "report/validation_page.h"

namespace ltc::cli {
namespace {

struct Arguments {
  std::string table;
  std::optional<ReadAs> layout;
  ConfigArguments config;
  std::string json, report;  // empty: none
  bool no_quality = false, no_invariants = false;
  int threads = processor_count();
};

constexpr const char* page_name = "index.html";

// DIR/index.html, or nothing.
std::filesystem::path page_of(const Arguments& arguments) {
  return arguments.report.empty() ? std::filesystem::path()
                                  : std::filesystem::path(arguments.report) / page_name;
}

std::string written_text(const std::filesystem::path& page) {
  return page.empty() ? "" : "\nwrote " + page.string() + "\n";
}

void validate(const Arguments& arguments, Files& files) {
  ProgressDisplay progress;
  const StopOnInterrupt stop_on_interrupt(progress);
  const RunContext run{arguments.threads, &progress};
  if (!arguments.report.empty())
    files.write("--report", files.make_folder(arguments.report) / page_name);
  Validation report{
      arguments.table, read_input(arguments.table, arguments.layout), {}, std::nullopt, {}};
  const ValidateSettings settings =
      load_validate_settings(arguments.config.path(), arguments.config.overrides,
                             settings_for(report.table), ConfigArguments::override_option);
  if (!arguments.no_invariants)
    report.invariants = check_invariants(report.table, settings.invariants, run,
                                         contents_of(arguments.table, report.table));
  if (!arguments.no_quality) {
    report.quality = measure_quality(report.table, settings.quality, run);
    report.thresholds = check_thresholds(*report.quality, settings.thresholds, settings.said);
    for (ThresholdCheck& check : report.thresholds)
      if (!check.reason.empty())
        check.reason = why_not_limited(report.table);
  }
  report.query_command = [&](const Lobe& lobe) { return query_command(arguments.table, lobe); };
  report.entry_command = [&](std::size_t flat) {
    return entry_command(arguments.table, report.table.grid, flat);
  };
  const std::string page = arguments.report.empty() ? "" : validation_page(report, {}, run);
  // The last chance to stop.
  run.throw_if_stopped();
  if (!page.empty())
    write_file(page_of(arguments), page);
  print_results(
      arguments.json, [&] { return report_text(report) + written_text(page_of(arguments)); },
      [&] { return report_json(report); });
  if (const std::string failure = failure_text(report); !failure.empty())
    throw CheckFailure(failure);
}

}  // namespace

Action declare_validate(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_table_argument(app, "TABLE", arguments->table, "table to check");
  add_layout_option(app, arguments->layout);
  add_config_options(app, arguments->config,
                     {"TOML file that says which limits differ from the defaults, those of "
                      "config/validate.toml or, "
                      "for a refined table, config/validate-refined.toml [none]",
                      "invariants.condition_number=1e5", "What to demand"});
  add_json_option(app, arguments->json)->group("What to write");
  CLI::Option* const page =
      add_folder_option(app, "--report", arguments->report,
                        "folder for a page with all figures and pictures, DIR/index.html")
          ->group("What to write");
  CLI::Option* const no_quality =
      app.add_flag("--no-quality", arguments->no_quality,
                   "check the invariants alone, which takes seconds; not with --report")
          ->excludes(page)
          ->group("What to demand");
  app.add_flag("--no-invariants", arguments->no_invariants,
               "measure how good the table is alone: of 64 nodes an axis, invariants take an hour; "
               "not with --report")
      ->excludes(page)
      ->excludes(no_quality)
      ->group("What to demand");
  add_threads_option(app, arguments->threads);
  return [arguments](Files& files) { validate(*arguments, files); };
}

}  // namespace ltc::cli
