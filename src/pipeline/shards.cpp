// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/shards.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/platform.h"
#include "core/ranks.h"
#include "core/stopwatch.h"
#include "export/checkpoint.h"
#include "pipeline/checkpoint_keeper.h"
#include "pipeline/first_entries.h"
#include "pipeline/work.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;

// Better refused than made by every shard anew.
void require_fits(const Config& config, const Work& work) {
  const bool has_fits =
      config.storage != Storage::folded && cost_of(config, work.to_fit, work.refinement()).fits > 0;
  if (!has_fits)
    throw InputError(fmt::format(
        "{} has no fits that shards could make: it is made as a whole; several machines share the "
        "work of one run as ranks of a build with MPI (mpirun)",
        config.field.size > 0               ? "a field"
        : config.storage == Storage::folded ? "a folded table"
                                            : "this table"));
  if (is_interpolated(config, work.to_fit))
    throw InputError(
        "a big table chooses its fits by those that it has, which no shard has all of; expected "
        "fit.interpolation = \"off\" for shards that fit every entry; or several machines share "
        "the work of one run as ranks of a build with MPI (mpirun)");
}

bool is_finished(const FinishedFits& fits, std::size_t flat) {
  return fits.rounds.front()[flat].status != Status::skipped;
}

// The journal's work, with what surrounds it; of the first rank.
void make_file(const RunRequest& request, const Work& work, const Shard& shard,
               const std::vector<PlannedEntry>& plan, const RunContext& run, ShardReport& report) {
  platform::require_writable_folder(request.folder);
  const platform::FolderLock lock(request.folder, true);
  platform::require_writable_file(report.file);
  const CheckpointTask task{report.file,         request.config,
                            work.to_fit,         request.checkpoint_seconds,
                            request.resume_name, shard};
  const std::unique_ptr<FitJournal> journal = open_journal(task, request.resume, request.warn);
  report.resumed = journal->count();
  platform::remove_abandoned_temporaries(report.file);
  CheckpointKeeper keeper(task, *journal, *run.progress);
  keeper.guard([&] {
    fit_shard(request.config.grid, request.config.fit, plan, shard, run, journal.get());
    keeper.close();
    keeper.write();
  });
}

// One line for all that is wrong: who has lost a shard wants to know whether others are lost too.
class Faults {
 public:
  template <typename... Values>
  void add(fmt::format_string<Values...> text, Values&&... values) {
    texts_.push_back(fmt::format(text, std::forward<Values>(values)...));
  }
  void require_none() const {
    if (!texts_.empty())
      throw InputError(fmt::format("{}", fmt::join(texts_, "; ")));
  }

 private:
  std::vector<std::string> texts_;
};

// The file of each shard by its number, none where that is at fault; `count` becomes that of all.
std::map<int, fs::path> files_by_number(const Config& config, const std::vector<fs::path>& files,
                                        int& count, Faults& faults) {
  std::map<int, fs::path> found;
  fs::path first;
  for (const fs::path& file : files) {
    ShardHeader header;
    try {
      header = read_shard_header(file);
    } catch (const InputError& error) {
      faults.add("{}", error.what());
      continue;
    }
    if (found.empty()) {
      count = header.shard.count;
      first = file;
    }
    if (header.shard.count != count) {
      faults.add("{} is of {} shards, {} of {}", file.string(), header.shard.count, first.string(),
                 count);
      continue;
    }
    const auto [at, is_new] = found.try_emplace(header.shard.number, file);
    if (!is_new)
      faults.add("shard {} of {} is there twice: {} and {}", header.shard.number, count,
                 at->second.string(), file.string());
    // One of another run has its place all the same: it is not missing, but wrong.
    if (const auto difference = first_difference(config, header.config, file)) {
      faults.add("{} was made with {} = {}; expected {}", file.string(), difference->key,
                 difference->other.empty() ? "nothing" : difference->other, difference->value);
      at->second.clear();
    }
  }
  return found;
}

// Its fits added to those of all.
void add_shard(const Config& config, const std::vector<bool>& needed,
               const std::vector<PlannedEntry>& plan, const Shard& shard, const fs::path& file,
               const std::string& resume_name, FinishedFits& all, Faults& faults) {
  FinishedFits own;
  try {
    own = read_checkpoint(config, needed, file, shard);
  } catch (const InputError& error) {
    faults.add("{}", error.what());
    return;
  }
  const std::vector<std::size_t> expected = entries_of_shard(plan, shard);
  std::size_t finished = 0;
  for (const std::size_t flat : expected) {
    if (!is_finished(own, flat))
      continue;
    ++finished;
    all.rounds.front().set(flat, own.rounds.front()[flat]);
  }
  if (finished < expected.size())
    faults.add("shard {} of {} is incomplete, {} of {} fits: {}; {} goes on with it", shard.number,
               shard.count, finished, expected.size(), file.string(), resume_name);
}

}  // namespace

fs::path shard_file(const Config& config, const fs::path& folder, const Shard& shard) {
  return folder /
         fmt::format("{}.shard-{}-of-{}.h5", config.output.name, shard.number, shard.count);
}

ShardReport make_shard(const RunRequest& request, const Shard& shard, const RunContext& context) {
  const Clock::time_point began = Clock::now();
  const Work work = plan_work(request, context.ranks);
  require_fits(request.config, work);
  const std::vector<PlannedEntry> plan =
      plan_of_fits(request.config, plan_by_symmetry(request.config.grid, work.to_fit, context));
  ShardReport report;
  report.file = shard_file(request.config, request.folder, shard);
  report.fits = entries_of_shard(plan, shard).size();
  StopOnly unwatched;
  const RunContext run{context.threads, context.progress ? context.progress : &unwatched,
                       context.ranks};
  if (is_first(context.ranks))
    make_file(request, work, shard, plan, run, report);
  else
    fit_shard(request.config.grid, request.config.fit, plan, shard, run, nullptr);
  report.seconds = seconds_since(began);
  return report;
}

FinishedFits merged_shards(const Config& config, const std::vector<bool>& needed,
                           const std::vector<fs::path>& files, const std::string& resume_name) {
  Faults faults;
  int count = 0;
  const std::map<int, fs::path> found = files_by_number(config, files, count, faults);
  for (int number = 1; number <= count; ++number) {
    const int first = number;
    while (number <= count && !found.contains(number))
      ++number;
    if (number - first == 1)
      faults.add("shard {} of {} is missing", first, count);
    else if (number > first)
      faults.add("shards {} to {} of {} are missing", first, number - 1, count);
  }
  const std::vector<PlannedEntry> plan =
      plan_of_fits(config, plan_by_symmetry(config.grid, needed));
  // Each round in its place: what is not finished there has no values.
  FinishedFits all = FitJournal(config.grid.size(), sweep_count(config.fit)).finished();
  for (const auto& [number, file] : found)
    if (!file.empty())
      add_shard(config, needed, plan, {number, count}, file, resume_name, all, faults);
  faults.require_none();
  return all;
}

std::string config_of_shards(const std::vector<fs::path>& files) {
  return read_shard_header(files.front()).config;
}

}  // namespace ltc
