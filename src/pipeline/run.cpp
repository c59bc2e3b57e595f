// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>

#include "core/error.h"
#include "core/platform.h"
#include "core/ranks.h"
#include "core/stopwatch.h"
#include "core/uninterrupted.h"
#include "export/table_file.h"
#include "judge/half_precision.h"
#include "pipeline/checkpoint_keeper.h"
#include "pipeline/shards.h"
#include "pipeline/work.h"
#include "table/extend.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;

// Of the others those that are there: left in the folder, they would be of another table than the
// files beside them. An input is not removed unasked.
std::vector<fs::path> files_to_remove(const std::vector<fs::path>& others,
                                      const RunRequest& request) {
  std::vector<fs::path> inputs = request.inputs, older;
  inputs.insert(inputs.end(), {request.scene, request.extend});
  std::error_code ignored;
  for (const fs::path& file : others) {
    if (!fs::exists(fs::symlink_status(file, ignored)) || fs::is_directory(file, ignored))
      continue;
    for (const fs::path& input : inputs)
      if (!input.empty() && fs::equivalent(input, file, ignored))
        throw InputError(
            fmt::format("{} is read by this run and belongs to the files that it replaces, but is "
                        "none that it writes: it would be removed; name another folder, or set "
                        "output.name",
                        file.string()));
    older.push_back(file);
  }
  return older;
}

// Temporary files of runs that were killed. Only with the folder locked.
void remove_abandoned(const FilesOfRun& files) {
  platform::remove_abandoned_temporaries(files.checkpoint);
  for (const fs::path& file : files.written)
    platform::remove_abandoned_temporaries(file);
}

std::size_t count(const std::vector<bool>& flags) {
  return static_cast<std::size_t>(std::ranges::count(flags, true));
}

// Nothing to write, rather than files of NaN.
void require_any_value(const Table& table) {
  const auto failed = std::ranges::count(table.status, Status::failed);
  if (failed > 0 && std::ranges::none_of(table.status, has_values))
    throw CheckFailure(fmt::format(
        "none of {} entries has a finite fit; nothing was written; other settings of the solver "
        "may do",
        failed));
}

void make_entries(const RunRequest& request, const Work& work, const RunContext& context,
                  FitJournal* journal, RunReport& report) {
  if (request.announce)
    request.announce(request.config, cost_of(request.config, work.to_fit, work.refinement()));
  report.table = generate_table(request.config, work.to_fit, context, &report.generate, journal,
                                work.refinement());
  report.table.created = request.created;
}

void join_existing(const Work& work, Table& table) {
  if (work.existing)
    table = extended(*work.existing, table);
  require_any_value(table);
}

// All or none: an older set of files stands until the new one is on the disk. Until then a stop is
// still possible; from then on `taking_places` is set.
void write_files(const RunRequest& request, const RunContext& context,
                 std::optional<Uninterrupted>& taking_places, RunReport& report) {
  const Clock::time_point began = Clock::now();
  const OutputSettings& output = request.config.output;
  platform::FileSet files;
  for (const Format& format : formats()) {
    context.throw_if_stopped();
    if (format.is_written(request.config))
      add_table(files, report.table, format, request.folder / output.name,
                write_options(format, output));
    else if (format.is_asked(request.config))
      report.left_out.emplace_back(
          format.name, format.why_not(request.config.grid, request.config.storage, output.layout));
  }
  for (const fs::path& file : report.removed)
    files.remove(file);
  context.throw_if_stopped();
  taking_places.emplace();
  files.commit();
  report.generate.stage_seconds.emplace_back("write", seconds_since(began));
}

// Of those that are not asked for by default, the others being left out with a word.
void require_formats(const Config& config) {
  if (config.output.header && config.output.c_header)
    throw InputError(fmt::format(
        "output.header and output.c_header both write {}.h; expected one of them to be true",
        config.output.name));
  if (config.field.loss > 0 && config.field.size == 0)
    throw InputError(fmt::format(
        "field.loss = {} without a field: field.size is 0; expected the most numbers it may have",
        config.field.loss));
  for (const Format& format : formats()) {
    if (!format.is_asked(config) || OutputSettings{}.*format.asked)
      continue;
    if (config.storage == Storage::folded && !format.of_folded)
      throw InputError(
          fmt::format("{}, which [output] asks for, cannot hold folded lobes", format.name));
    if (config.storage == Storage::folded && format.of_one_pair && config.field.creases.size() > 1)
      throw InputError(
          fmt::format("{}, which [output] asks for, holds folded lobes with one pair of creases; "
                      "fit.second_crease = {}, expected 0",
                      format.name, config.fit.second_crease));
    if (const std::string why = format.why_not(config.grid, config.storage, config.output.layout);
        !why.empty())
      throw InputError(fmt::format("{}, which [output] asks for, cannot hold this table: it {}",
                                   format.name, why));
  }
}

// The fits that there are: of the run that is resumed, or of shards.
std::unique_ptr<FitJournal> journal_of(const RunRequest& request, const CheckpointTask& task) {
  std::error_code ignored;
  if (request.shards.empty() || fs::exists(task.file, ignored))
    return open_journal(task, request.resume, request.warn);
  return std::make_unique<FitJournal>(
      merged_shards(request.config, task.needed, request.shards, request.resume_name));
}

// Fits the table and writes its files, or leaves a checkpoint to go on from.
void make_files(const RunRequest& request, const Work& work, const RunContext& context,
                RunReport& report) {
  require_formats(request.config);
  platform::require_writable_folder(request.folder);
  const platform::FolderLock lock(request.folder);
  const FilesOfRun files = files_of_run(request.config, request.folder);
  report.files = files.written;
  report.removed = files_to_remove(files.others, request);
  for (const fs::path& file : files.written)
    platform::require_writable_file(file);
  const CheckpointTask task{files.checkpoint, request.config, work.to_fit,
                            request.checkpoint_seconds, request.resume_name};
  const std::unique_ptr<FitJournal> journal = journal_of(request, task);
  report.resumed = journal->count();
  remove_abandoned(files);
  CheckpointKeeper keeper(task, *journal, *context.progress);
  std::optional<Uninterrupted> until_removed;  // the checkpoint of a table that is written
  keeper.guard([&] {
    make_entries(request, work, context, journal.get(), report);
    keeper.close();
    join_existing(work, report.table);
    write_files(request, context, until_removed, report);
  });
  keeper.remove();
}

// What 16-bit values cost, where any were written.
std::string half_text(const RunRequest& request, const Table& table, int threads) {
  const bool written = std::ranges::any_of(formats(), [&](const Format& format) {
    return format.is_written(request.config) && write_options(format, request.config.output).half;
  });
  if (request.folder.empty() || !written)
    return "";
  std::vector<bool> judged(table.status.size());
  std::transform(table.status.begin(), table.status.end(), judged.begin(), has_values);
  return half_precision_text(table.grid, half_precision_errors(table, judged, {threads}));
}

}  // namespace

FilesOfRun files_of_run(const Config& config, const fs::path& folder) {
  const fs::path prefix = folder / config.output.name;
  FilesOfRun files;
  for (const Format& format : formats()) {
    TableFiles written;
    if (format.is_written(config))
      written = format.files(prefix, config.grid, config.storage, config.output.layout);
    std::ranges::copy(written, std::back_inserter(files.written));
    if (format.ending_of_others)
      continue;
    std::ranges::copy_if(
        format.all_files(prefix), std::back_inserter(files.others),
        [&](const fs::path& file) { return std::ranges::find(written, file) == written.end(); });
  }
  files.checkpoint = prefix.string() + ".checkpoint.h5";
  return files;
}

RunReport make_table(const RunRequest& request, const RunContext& context) {
  const Clock::time_point began = Clock::now();
  const Work work = plan_work(request, context.ranks);
  RunReport report;
  report.needed = count(work.needed);
  report.added = count(work.to_fit);
  report.extends = work.existing.has_value();
  if (request.folder.empty() || !is_first(context.ranks)) {
    make_entries(request, work, context, nullptr, report);
    join_existing(work, report.table);
  } else {
    StopOnly unwatched;  // a checkpoint that cannot be written asks for a stop
    make_files(request, work,
               {context.threads, context.progress ? context.progress : &unwatched, context.ranks},
               report);
  }
  if (is_first(context.ranks))
    report.half = half_text(request, report.table, context.threads);
  report.seconds = seconds_since(began);
  report.peak_memory_bytes = platform::peak_memory_bytes();
  return report;
}

}  // namespace ltc
