// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/table_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/cost_text.h"
#include "cli/creation_time.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/summary.h"
#include "core/error.h"
#include "export/table_file.h"
#include "table/entry_text.h"

namespace ltc::cli {
namespace {

constexpr double most_checkpoint_seconds = 86400;

// The config of the first rank, on all: of a pipe the others would read nothing.
Config shared_config(const std::function<Config()>& load) {
  Ranks* const ranks = launched_ranks();
  if (is_first(ranks)) {
    Config config = load();
    std::string toml = to_toml(config);
    share_from_first(ranks, toml);
    return config;
  }
  std::string toml;
  share_from_first(ranks, toml);
  return parse_config(toml, "config", {});
}

RunRequest request_of(const TableRunArguments& arguments, const std::function<Config()>& load) {
  RunRequest request;
  request.created = creation_time();
  request.config = shared_config(load);
  request.scene = arguments.scene;
  request.extend = arguments.extend;
  request.folder = arguments.output;
  request.resume = arguments.resume;
  request.checkpoint_seconds = arguments.checkpoint_seconds;
  request.resume_name = "--resume";
  if (!is_first(launched_ranks()))
    return request;
  request.warn = warn;
  request.announce = [](const Config& config, const Cost& cost) { tell(cost_text(config, cost)); };
  return request;
}

// A refined entry is no fit any more, and one that was taken over is of another run: then the file
// alone tells what it holds.
SummaryCommands commands_of(const RunReport& report, const std::string& fit_command) {
  SummaryCommands commands;
  const bool refined =
      report.table.field || (report.generate.refine && report.generate.refine->kept);
  if (!report.extends && !report.table.field)
    commands.fit = fit_command;
  if ((refined || report.extends || fit_command.empty()) && !report.files.empty())
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

}  // namespace

void add_table_run_options(CLI::App& app, TableRunArguments& arguments) {
  constexpr const char* where = "What to write";
  add_input_option(
      app, "--scene", arguments.scene,
      "fit only what this scene's materials need: TOML, .gltf or .glb [the whole table]")
      ->group(what_to_fit);
  // No input that Files keeps from being replaced: the table may be extended where it lies, for it
  // keeps all that it holds.
  const std::string whole = endings_text(keeps_fits);
  allow(app.add_option(
            "--extend", arguments.extend,
            fmt::format("keep the entries of this {} bit for bit and add what is lacking [none]",
                        whole)),
        {"a table's " + whole, [](std::string& text) { return is_whole_table(text); }})
      ->option_text("FILE")
      ->group(what_to_fit);
  add_folder_option(app, "-o,--output", arguments.output, "folder for the files")->group(where);
  add_json_option(app, arguments.json)->group(where);
  app.add_flag("--resume", arguments.resume,
               "go on from the checkpoint that a run left in the folder when it was cut short")
      ->group(how_to_run);
  allow(app.add_option("--checkpoint-seconds", arguments.checkpoint_seconds,
                       fmt::format("time between checkpoints, up to {}; 0: none [{}]",
                                   most_checkpoint_seconds, arguments.checkpoint_seconds)),
        number({0, most_checkpoint_seconds}))
      ->option_text("S")
      ->group(how_to_run);
  add_threads_option(app, arguments.threads);
}

void run_watched(const TableRunArguments& arguments, const std::function<Config()>& load,
                 Files& files,
                 const std::function<void(RunRequest& request, const RunContext& context)>& work) {
  Ranks* const ranks = launched_ranks();
  std::unique_ptr<Progress> progress;
  if (is_first(ranks))
    progress = std::make_unique<ProgressDisplay>();
  else
    progress = std::make_unique<StopOnly>();
  StopOnInterrupt stop_on_interrupt(*progress, is_first(ranks));
  RunRequest request = request_of(arguments, load);
  if (is_first(ranks)) {
    files.make_folder(request.folder);
    stop_on_interrupt.set_checkpoint(files_of_run(request.config, request.folder).checkpoint);
  }
  work(request, {arguments.threads, progress.get(), ranks});
}

void make_and_tell(const TableRunArguments& arguments, const RunRequest& request,
                   const RunContext& context, Files& files, const std::string& fit_command) {
  if (!is_first(context.ranks)) {
    make_table(request, context);
    return;
  }
  const FilesOfRun of_run = files_of_run(request.config, request.folder);
  for (const std::filesystem::path& file : of_run.written)
    files.write("--output", file);
  files.write("--output", of_run.checkpoint);
  const RunReport report = make_table(request, context);
  const SummaryCommands commands = commands_of(report, fit_command);
  print_results(
      arguments.json, [&] { return summary_text(report, commands); },
      [&] { return summary_json(report); });
  require_none_failed(report.table);
}

}  // namespace ltc::cli
