// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit validate: whether a table is sound.
#include <memory>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/validate_report.h"
#include "core/error.h"
#include "export/file.h"
#include "export/reader.h"
#include "validate/validate_settings.h"

namespace ltc::cli {
namespace {

struct Arguments {
  std::string table;
  ConfigArguments config;
  std::string json;  // empty: none
  int threads = default_threads();
};

void validate(const Arguments& arguments) {
  ProgressDisplay progress;
  const StopOnInterrupt stop_on_interrupt(progress);
  const ValidateSettings settings =
      load_validate_settings(arguments.config.path(), arguments.config.overrides);
  ValidateReport report{arguments.table, read_table(arguments.table), {}};
  const std::optional<OutputFolder> folder = folder_of_file(arguments.json);
  report.invariants = check_invariants(report.table, settings.invariants, arguments.threads,
                                       &progress, contents_of(arguments.table));
  if (!arguments.json.empty())
    write_file(arguments.json, report_json(report));
  print(report_text(report));
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
                     {"TOML file that says which limits differ from the defaults [none]",
                      "invariants.condition_number=1e5", "What to demand"});
  app.add_option("--json", arguments->json, "write all that was found to this file [none]")
      ->option_text("FILE")
      ->group("What to write");
  add_threads_option(app, arguments->threads);
  return [arguments] { validate(*arguments); };
}

}  // namespace ltc::cli
