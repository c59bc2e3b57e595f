// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit generate: config in, table files out.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/command.h"
#include "cli/cost_text.h"
#include "cli/creation_time.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/summary.h"
#include "core/error.h"
#include "core/parallel.h"
#include "export/table_file.h"
#include "pipeline/run.h"
#include "table/entry_text.h"

namespace ltc::cli {
namespace {

struct Arguments {
  ConfigArguments config;
  std::string scene;                 // empty: the whole table
  std::string extend;                // empty: a new table
  std::string output = "out", json;  // json empty: none
  int threads = processor_count();
  bool resume = false;
  double checkpoint_seconds = RunRequest().checkpoint_seconds;
};

constexpr double most_checkpoint_seconds = 86400;

RunRequest request_of(const Arguments& arguments, Files& files) {
  RunRequest request;
  request.created = creation_time();
  request.config = arguments.config.load();
  request.scene = arguments.scene;
  request.extend = arguments.extend;
  request.folder = files.make_folder(arguments.output);
  request.resume = arguments.resume;
  request.checkpoint_seconds = arguments.checkpoint_seconds;
  request.resume_name = "--resume";
  request.inputs = {arguments.config.file};
  request.warn = warn;
  request.announce = [](const Config& config, const Cost& cost) { tell(cost_text(config, cost)); };
  const FilesOfRun of_run = files_of_run(request.config, request.folder);
  for (const std::filesystem::path& file : of_run.written)
    files.write("--output", file);
  files.write("--output", of_run.checkpoint);
  return request;
}

// A refined entry is no fit any more, and one that was taken over is of another run: then the file
// alone tells what it holds.
SummaryCommands commands_of(const Arguments& arguments, const RunReport& report) {
  SummaryCommands commands;
  const bool refined =
      report.table.field || (report.generate.refine && report.generate.refine->kept);
  if (!report.extends && !report.table.field) {
    commands.fit = "ltcfit fit" + arguments.config.as_text();
    if (!arguments.scene.empty())
      commands.fit += " --scene " + shell_quoted(arguments.scene);
    commands.fit += " --entry";
  }
  if ((refined || report.extends) && !report.files.empty())
    commands.stored =
        fmt::format("ltcfit fit --as-in {} --entry", shell_quoted(report.files.front().string()));
  return commands;
}

// The files are there, but whoever waits for them should know.
void require_none_failed(const Table& table) {
  const auto first = std::ranges::find(table.status, Status::failed);
  if (first == table.status.end())
    return;
  throw CheckFailure(
      fmt::format("{} of {} entries have no finite fit and hold NaN, entry {} the first; the files "
                  "were written",
                  std::ranges::count(table.status, Status::failed), table.status.size(),
                  entry_text(table.grid, static_cast<std::size_t>(first - table.status.begin()))));
}

void generate(const Arguments& arguments, Files& files) {
  ProgressDisplay progress;
  StopOnInterrupt stop_on_interrupt(progress);
  const RunRequest request = request_of(arguments, files);
  stop_on_interrupt.set_checkpoint(files_of_run(request.config, request.folder).checkpoint);
  const RunReport report = make_table(request, {arguments.threads, &progress});
  const SummaryCommands commands = commands_of(arguments, report);
  print_results(
      arguments.json, [&] { return summary_text(report, commands); },
      [&] { return summary_json(report); });
  require_none_failed(report.table);
}

}  // namespace

Action declare_generate(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_config_options(app, arguments->config);
  constexpr const char *what = "What to fit", *how = "How to run", *where = "What to write";
  add_input_option(
      app, "--scene", arguments->scene,
      "fit only what this scene's materials need: TOML, .gltf or .glb [the whole table]")
      ->group(what);
  // No input that Files keeps from being replaced: the table may be extended where it lies, for it
  // keeps all that it holds.
  const std::string whole = endings_text(keeps_fits);
  allow(app.add_option(
            "--extend", arguments->extend,
            fmt::format("keep the entries of this {} bit for bit and add what is lacking [none]",
                        whole)),
        {"a table's " + whole, [](std::string& text) { return is_whole_table(text); }})
      ->option_text("FILE")
      ->group(what);
  add_folder_option(app, "-o,--output", arguments->output, "folder for the files")->group(where);
  add_json_option(app, arguments->json)->group(where);
  app.add_flag("--resume", arguments->resume,
               "go on from the checkpoint that a run left in the folder when it was cut short")
      ->group(how);
  allow(app.add_option("--checkpoint-seconds", arguments->checkpoint_seconds,
                       fmt::format("time between checkpoints, up to {}; 0: none [{}]",
                                   most_checkpoint_seconds, arguments->checkpoint_seconds)),
        number({0, most_checkpoint_seconds}))
      ->option_text("S")
      ->group(how);
  add_threads_option(app, arguments->threads);
  return [arguments](Files& files) { generate(*arguments, files); };
}

}  // namespace ltc::cli
