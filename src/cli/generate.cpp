// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit generate: config in, table files out.
#include "pipeline/generate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "cli/checkpoint_keeper.h"
#include "cli/command.h"
#include "cli/cost_text.h"
#include "cli/creation_time.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/scene_file.h"
#include "cli/summary.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/platform.h"
#include "core/uninterrupted.h"
#include "export/exr.h"
#include "export/hdf5.h"
#include "export/npy.h"
#include "export/reader.h"
#include "judge/half_precision.h"
#include "scene/coverage.h"
#include "scene/query_ranges.h"
#include "table/entry_text.h"
#include "table/extend.h"

namespace ltc::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  ConfigArguments config;
  std::string scene;                 // empty: the whole table
  std::string extend;                // empty: a new table
  std::string output = "out", json;  // json empty: none
  int threads = processor_count();
  bool resume = false;
  double checkpoint_seconds = 5;
};

constexpr double most_checkpoint_seconds = 86400;

// NPY says nothing of axes and storage: it is for the paper's grid alone.
bool writes_npy(const Config& config) {
  return config.output.npy && npy_can_hold(config.grid);
}

// The files that a run writes, and the others that a set of this name can have.
struct FilesOfSet {
  std::vector<fs::path> written, others;
};

FilesOfSet files_of(const Config& config, const fs::path& folder) {
  const OutputSettings& output = config.output;
  FilesOfSet files;
  const auto add = [&](const std::string& ending, bool written) {
    (written ? files.written : files.others).push_back(folder / (output.name + ending));
  };
  add(".h5", output.hdf5);
  for (int i = 0; i < 3; ++i)
    add(fmt::format(".{}.exr", i), output.exr);
  add(".npy", writes_npy(config));
  return files;
}

// Of the others those that are there: left in the folder, they would be of another table than the
// files beside them. An input is not removed unasked.
std::vector<fs::path> files_to_remove(const std::vector<fs::path>& others,
                                      const Arguments& arguments) {
  std::vector<fs::path> older;
  std::error_code ignored;
  for (const fs::path& file : others) {
    if (!fs::exists(fs::symlink_status(file, ignored)) || fs::is_directory(file, ignored))
      continue;
    for (const std::string& input : {arguments.extend, arguments.config.file, arguments.scene})
      if (!input.empty() && fs::equivalent(input, file, ignored))
        throw InputError(
            fmt::format("{} is read by this run and belongs to the files that it replaces, but is "
                        "none that it writes: it would be removed; name another folder with "
                        "--output, or set output.name",
                        file.string()));
    older.push_back(file);
  }
  return older;
}

fs::path checkpoint_of(const Config& config, const fs::path& folder) {
  return folder / (config.output.name + ".checkpoint.h5");
}

// All or none: an older set of files stands until the new one is on the disk. Until then a stop is
// still possible; from then on `taking_places` is set.
void write_files(const Table& table, const Config& config, const fs::path& folder,
                 const std::vector<fs::path>& removed, const Progress& progress,
                 std::optional<Uninterrupted>& taking_places) {
  const OutputSettings& output = config.output;
  platform::FileSet files;
  progress.throw_if_stopped();
  if (output.hdf5)
    add_hdf5(files, table, folder / (output.name + ".h5"));
  progress.throw_if_stopped();
  if (output.exr)
    add_exr(files, table, folder / output.name, output.exr_half);
  progress.throw_if_stopped();
  if (writes_npy(config))
    add_npy(files, table, folder / (output.name + ".npy"));
  for (const fs::path& file : removed)
    files.remove(file);
  progress.throw_if_stopped();
  taking_places.emplace();
  files.commit();
}

// Temporary files of runs that were killed. Only with the folder locked.
void remove_abandoned(const std::vector<fs::path>& files, const fs::path& checkpoint) {
  platform::remove_abandoned_temporaries(checkpoint);
  for (const fs::path& file : files)
    platform::remove_abandoned_temporaries(file);
}

// What a scene and an existing table leave to do.
struct Work {
  std::vector<bool> needed;  // by the scene
  std::vector<bool> to_fit;  // needed and not in the existing table
  std::optional<Table> existing;
  std::vector<QueryRange> asked;  // by the scene's materials; none without a scene
};

Work plan_work(const Arguments& arguments, const Config& config) {
  Work work;
  work.needed.assign(config.grid.size(), true);
  if (!arguments.scene.empty()) {
    const Scene scene = load_scene_and_warn(arguments.scene);
    work.needed = needed_entries(scene, config.grid);
    work.asked = query_ranges(scene);
  }
  work.to_fit = work.needed;
  if (!arguments.extend.empty()) {
    work.existing = read_table(arguments.extend);
    require_extendable(*work.existing, arguments.extend, config.grid, config.storage, config.brdf);
    work.to_fit = lacking_entries(*work.existing, work.needed);
  }
  return work;
}

RefineContext refine_context(const Work& work) {
  return {work.asked, work.existing ? &*work.existing : nullptr};
}

std::size_t count_true(const std::vector<bool>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::size_t count_failed(const Table& table) {
  return static_cast<std::size_t>(
      std::count(table.status.begin(), table.status.end(), Status::failed));
}

std::vector<bool> with_values(const Table& table) {
  std::vector<bool> entries(table.status.size());
  std::transform(table.status.begin(), table.status.end(), entries.begin(), has_values);
  return entries;
}

// Nothing to write, rather than files of NaN.
void require_any_value(const Table& table) {
  if (count_failed(table) > 0 && std::none_of(table.status.begin(), table.status.end(), has_values))
    throw CheckFailure(fmt::format(
        "none of {} entries has a finite fit; nothing was written; other settings of the solver "
        "may do",
        count_failed(table)));
}

// Fits the table and writes its files, or leaves a checkpoint to go on from.
Table make_files(const Arguments& arguments, const Config& config, const Work& work,
                 const fs::path& folder, const std::string& created, Progress& progress,
                 RunReport& report) {
  const CheckpointTask task{checkpoint_of(config, folder), config, work.to_fit,
                            arguments.checkpoint_seconds};
  const std::unique_ptr<FitJournal> journal = open_journal(task, arguments.resume);
  report.resumed = journal->count();
  remove_abandoned(report.files, task.file);
  Table table;
  CheckpointKeeper keeper(task, *journal, progress);
  std::optional<Uninterrupted> until_removed;  // the checkpoint of a table that is written
  keeper.guard([&] {
    table = generate_table(config, work.to_fit, {arguments.threads, &progress}, &report.generate,
                           journal.get(), refine_context(work));
    table.created = created;
    keeper.close();
    if (work.existing)
      table = extended(*work.existing, table);
    require_any_value(table);
    const Clock::time_point writing_began = Clock::now();
    write_files(table, config, folder, report.removed, progress, until_removed);
    report.generate.stage_seconds.emplace_back("write", seconds_since(writing_began));
  });
  keeper.remove();
  return table;
}

// The files are there, but whoever waits for them should know.
void require_none_failed(const Table& table) {
  const std::size_t failed = count_failed(table);
  if (failed == 0)
    return;
  const auto first = std::find(table.status.begin(), table.status.end(), Status::failed);
  throw CheckFailure(
      fmt::format("{} of {} entries have no finite fit and hold NaN, entry {} the first; the files "
                  "were written",
                  failed, table.status.size(),
                  entry_text(table.grid, static_cast<std::size_t>(first - table.status.begin()))));
}

// A refined entry is no fit any more, and one that was taken over is of another run: then the file
// alone tells what it holds.
void name_commands(const Arguments& arguments, RunReport& report) {
  const bool refined = report.generate.refine && report.generate.refine->kept;
  if (!report.extends) {
    report.fit_command = "ltcfit fit" + arguments.config.as_text();
    if (!arguments.scene.empty())
      report.fit_command += " --scene " + shell_quoted(arguments.scene);
    report.fit_command += " --entry";
  }
  if ((refined || report.extends) && !report.files.empty())
    report.stored_command =
        fmt::format("ltcfit fit --as-in {} --entry", shell_quoted(report.files.front().string()));
}

void generate(const Arguments& arguments, Files& files) {
  const Clock::time_point began = Clock::now();
  ProgressDisplay progress;
  StopOnInterrupt stop_on_interrupt(progress);

  const std::string created = creation_time();
  const Config config = arguments.config.load();
  const Work work = plan_work(arguments, config);
  require_memory(config, work.to_fit, refine_context(work));
  tell(cost_text(config, cost_of(config, work.to_fit, refine_context(work))));
  const fs::path folder = files.make_folder(arguments.output);
  const platform::FolderLock lock(folder);
  RunReport report;
  const FilesOfSet set = files_of(config, folder);
  report.files = set.written;
  report.removed = files_to_remove(set.others, arguments);
  for (const fs::path& file : report.files)
    files.write("--output", file);
  files.write("--output", checkpoint_of(config, folder));
  stop_on_interrupt.set_checkpoint(checkpoint_of(config, folder));

  const Table table = make_files(arguments, config, work, folder, created, progress, report);
  report.needed = count_true(work.needed);
  report.added = count_true(work.to_fit);
  report.extends = work.existing.has_value();
  if (config.output.exr && config.output.exr_half)
    report.half = half_precision_text(
        table.grid, half_precision_errors(table, with_values(table), {arguments.threads}));
  report.npy_left_out = config.output.npy && !writes_npy(config);
  report.seconds = seconds_since(began);
  report.peak_memory_bytes = platform::peak_memory_bytes();
  name_commands(arguments, report);
  print_results(
      arguments.json, [&] { return summary_text(table, report); },
      [&] { return summary_json(table, report); });
  require_none_failed(table);
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
  allow(app.add_option("--extend", arguments->extend,
                       "keep the entries of this .h5 bit for bit and add what is lacking [none]"),
        {"a table's .h5", [](std::string& text) { return fs::path(text).extension() == ".h5"; }})
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
