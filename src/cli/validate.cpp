// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit validate: whether a table is sound, and how good it is.
#include <memory>

#include "cli/command.h"
#include "cli/fit_command.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/validate_report.h"
#include "core/error.h"
#include "core/write_file.h"
#include "export/reader.h"
#include "report/validation_page.h"
#include "validate/validate_settings.h"

namespace ltc::cli {
namespace {

struct Arguments {
  std::string table;
  ConfigArguments config;
  std::string json, report;  // empty: none
  bool no_quality = false;
  int threads = default_threads();
};

// DIR/index.html, or nothing.
std::filesystem::path page_of(const Arguments& arguments) {
  return arguments.report.empty() ? std::filesystem::path()
                                  : std::filesystem::path(arguments.report) / "index.html";
}

std::string written_text(const std::filesystem::path& page) {
  return page.empty() ? "" : "\nwrote " + page.string() + "\n";
}

void validate(const Arguments& arguments) {
  ProgressDisplay progress;
  const StopOnInterrupt stop_on_interrupt(progress);
  Validation report{arguments.table, read_table(arguments.table), {}, std::nullopt, {}};
  const ValidateSettings settings = load_validate_settings(
      arguments.config.path(), arguments.config.overrides,
      is_refined(report.table) ? settings_for_refined_tables() : ValidateSettings{});
  const std::optional<OutputFolder> json_folder = folder_of_file(arguments.json);
  const std::optional<OutputFolder> page_folder = folder_of_file(page_of(arguments));
  report.invariants = check_invariants(report.table, settings.invariants, arguments.threads,
                                       &progress, contents_of(arguments.table));
  if (!arguments.no_quality) {
    report.quality = measure_quality(report.table, settings.quality, arguments.threads, &progress);
    report.thresholds = check_thresholds(*report.quality, settings.thresholds, settings.said);
  }
  const std::string page =
      arguments.report.empty() ? "" : validation_page(report, {}, arguments.threads, &progress);
  // The last chance to stop.
  progress.throw_if_stopped();
  if (!page.empty())
    write_file(page_of(arguments), page);
  if (!arguments.json.empty())
    write_file(arguments.json, report_json(report));
  print(report_text(report) + written_text(page_of(arguments)));
  if (const std::string failure = failure_text(report); !failure.empty())
    throw CheckFailure(failure);
}

}  // namespace

Action declare_validate(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  app.add_option("TABLE", arguments->table, "table to check, .h5, .npy or .0.exr")
      ->required()
      ->option_text(" ");
  add_config_options(app, arguments->config,
                     {"TOML file that says which limits differ from the defaults, those of "
                      "config/validate.toml or, "
                      "for a refined table, config/validate-refined.toml [none]",
                      "invariants.condition_number=1e5", "What to demand"});
  app.add_option("--json", arguments->json, "write all that was found to this file [none]")
      ->option_text("FILE")
      ->group("What to write");
  CLI::Option* const page =
      app.add_option("--report", arguments->report,
                     "write a page with all figures and pictures, DIR/index.html [none]")
          ->option_text("DIR")
          ->group("What to write");
  app.add_flag("--no-quality", arguments->no_quality,
               "check the invariants alone, which takes seconds")
      ->excludes(page)
      ->group("What to demand");
  add_threads_option(app, arguments->threads);
  return [arguments] { validate(*arguments); };
}

}  // namespace ltc::cli
