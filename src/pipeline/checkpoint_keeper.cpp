// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/checkpoint_keeper.h"

#include <fmt/format.h>

#include <chrono>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/uninterrupted.h"
#include "export/checkpoint.h"
#include "fit/fit_table.h"

namespace ltc {

namespace fs = std::filesystem;

std::string with_way_on(const std::string& message, const fs::path& checkpoint,
                        const std::string& resume_name) {
  std::error_code ignored;
  return fs::exists(checkpoint, ignored)
             ? fmt::format("{}; {} goes on from {}", message, resume_name, checkpoint.string())
             : message;
}

CheckpointKeeper::CheckpointKeeper(const CheckpointTask& task, FitJournal& journal,
                                   Progress& progress)
    : task_(task), journal_(journal), progress_(progress), written_count_(journal.count()) {
  if (task_.seconds > 0)
    writer_ = std::thread([this] { write_until_closed(); });
}

CheckpointKeeper::~CheckpointKeeper() {
  end_thread();
}

void CheckpointKeeper::guard(const std::function<void()>& work) {
  try {
    guard_stops(work);
  } catch (const InputError& error) {
    save_if_possible();
    throw InputError(with_way_on(error.what(), task_.file, task_.resume_name));
  } catch (const IoError& error) {
    save_if_possible();
    throw IoError(with_way_on(error.what(), task_.file, task_.resume_name));
  }
}

void CheckpointKeeper::save_if_possible() {
  end_thread();
  try {
    if (exists())
      write_if_new();
  } catch (const IoError&) {
    // The one before stands, and what the run ended with is the message to give.
  }
}

void CheckpointKeeper::guard_stops(const std::function<void()>& work) {
  try {
    work();
  } catch (const Interrupted&) {
    const Uninterrupted saved;
    close();  // throws if the stop was asked for here
    if (!exists())
      throw;
    write_if_new();
    throw Interrupted(with_way_on("interrupted", task_.file, task_.resume_name));
  }
}

void CheckpointKeeper::close() {
  end_thread();
  if (failure_)
    std::rethrow_exception(std::exchange(failure_, nullptr));
}

void CheckpointKeeper::end_thread() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  wake_.notify_all();
  if (writer_.joinable())
    writer_.join();
}

void CheckpointKeeper::write_until_closed() {
  const std::chrono::duration<double> interval(task_.seconds);
  std::unique_lock lock(mutex_);
  try {
    while (!wake_.wait_for(lock, interval, [this] { return closed_; }))
      write_if_new();
  } catch (...) {
    failure_ = std::current_exception();
    progress_.request_stop();
  }
}

void CheckpointKeeper::write_if_new() {
  const std::size_t count = journal_.count();
  if (count == written_count_)
    return;
  write();
  written_count_ = count;
}

void CheckpointKeeper::write() const {
  write_checkpoint(task_.config, task_.needed, journal_.finished(), task_.file, task_.shard);
}

bool CheckpointKeeper::exists() const {
  std::error_code ignored;
  return fs::exists(task_.file, ignored);
}

void CheckpointKeeper::remove() {
  std::error_code error;
  fs::remove(task_.file, error);
  if (error)
    throw IoError(
        fmt::format("cannot remove checkpoint {}: {}", task_.file.string(), error.message()));
}

std::unique_ptr<FitJournal> open_journal(const CheckpointTask& task, bool resume,
                                         const std::function<void(const std::string&)>& warn) {
  std::error_code ignored;
  const bool exists = fs::exists(task.file, ignored);
  if (exists && !resume)
    throw InputError(fmt::format(
        "{} holds the fits of a {}; go on with {}, or remove it to begin anew", task.file.string(),
        task.shard ? "shard" : "run that did not end", task.resume_name));
  if (exists)
    return std::make_unique<FitJournal>(
        read_checkpoint(task.config, task.needed, task.file, task.shard));
  if (resume && warn)
    warn(fmt::format("no checkpoint {}; starting from the beginning", task.file.string()));
  return std::make_unique<FitJournal>(task.config.grid.size(), sweep_count(task.config.fit));
}

}  // namespace ltc
