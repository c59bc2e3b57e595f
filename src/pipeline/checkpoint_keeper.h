// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Keeps a checkpoint of a run's fits while it works.
#pragma once

#include <condition_variable>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "config/config.h"
#include "core/progress.h"
#include "fit/fit_journal.h"

namespace ltc {

// What a checkpoint is of, and where it lies.
struct CheckpointTask {
  std::filesystem::path file;
  const Config& config;
  const std::vector<bool>& needed;
  double seconds = 5;               // between two of them; 0: none
  std::string resume_name;          // the option that goes on from it, in messages
  std::optional<Shard> shard = {};  // of a shard's fits
};

// The message, and what goes on from this file if there is one.
std::string with_way_on(const std::string& message, const std::filesystem::path& checkpoint,
                        const std::string& resume_name);

// One thread of its own writes the file every so many seconds, if there is anything new, and sleeps
// in between. What it cannot write ends the run at once, while little is lost: it asks `progress`
// for a stop, and close() throws the reason.
class CheckpointKeeper {
 public:
  CheckpointKeeper(const CheckpointTask& task, FitJournal& journal, Progress& progress);
  ~CheckpointKeeper();
  CheckpointKeeper(const CheckpointKeeper&) = delete;
  CheckpointKeeper& operator=(const CheckpointKeeper&) = delete;

  // Does the work of the run. Where it ends with an error and there is a checkpoint, brings that up
  // to date and adds to the message what goes on from it.
  void guard(const std::function<void()>& work);

  // Writes it, whether there is anything new or not: the file of a shard that is done. After
  // close().
  void write() const;

  // No more of them are written. Throws IoError if one could not be. Before anything else uses
  // HDF5, which knows no threads.
  void close();

  // After close(): the run is done and needs none.
  void remove();

 private:
  void guard_stops(const std::function<void()>& work);
  void save_if_possible();
  void end_thread();
  void write_until_closed();
  void write_if_new();
  bool exists() const;

  const CheckpointTask task_;
  FitJournal& journal_;
  Progress& progress_;
  std::size_t written_count_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool closed_ = false;
  std::exception_ptr failure_;
  std::thread writer_;
};

// The fits to go on with. Without `resume` none, and an InputError if the file exists: it may hold
// hours of another run. With it, those of the file; where there is no file, none, and a warning.
// Throws as read_checkpoint does.
std::unique_ptr<FitJournal> open_journal(const CheckpointTask& task, bool resume,
                                         const std::function<void(const std::string&)>& warn);

}  // namespace ltc
