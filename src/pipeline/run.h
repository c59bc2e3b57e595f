// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A whole run: the pipeline (pipeline/generate.h) with the scene that it serves, the table that it
// extends, the checkpoints that it leaves and the files that it writes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "config/config.h"
#include "core/run_context.h"
#include "pipeline/generate.h"
#include "table/table.h"

namespace ltc {

struct RunRequest {
  Config config;
  std::filesystem::path scene;   // only what its materials need is made; empty: the whole table
  std::filesystem::path extend;  // a table's file, whose entries are kept bit for bit; empty: none
  std::string created;           // the time that the table states

  std::filesystem::path folder;   // for the files, made if need be; empty: none are written
  bool resume = false;            // goes on from the checkpoint that lies in the folder, if any
  double checkpoint_seconds = 5;  // between two of them; 0: none
  // Files of all shards (pipeline/shards.h), whose fits are taken; none: all is fitted.
  std::vector<std::filesystem::path> shards = {};
  std::string resume_name = "resume";  // what whoever reads messages asks for it by
  // What the caller has read beside scene and table: a run that would remove it is refused.
  std::vector<std::filesystem::path> inputs = {};
  // Hears what a user should know and is no error, a line at a time. May be empty.
  std::function<void(const std::string& line)> warn = {};
  // Hears what the run will cost, once nothing stands in its way. May be empty.
  std::function<void(const Config& config, const Cost& cost)> announce = {};
};

struct RunReport {
  Table table;
  GenerateReport generate;
  std::size_t needed = 0;   // entries that the scene needs; all without a scene
  std::size_t added = 0;    // of these, not in the table that is extended
  bool extends = false;     // whether one is
  std::size_t resumed = 0;  // fits taken from a checkpoint, or from shards
  std::string half;         // what 16-bit textures cost, in words; empty: none were written
  std::vector<std::filesystem::path> files;
  std::vector<std::filesystem::path>
      removed;  // older files of the set that this run does not write
  // Formats that the config asks for and that cannot hold the table, and why.
  std::vector<std::pair<std::string, std::string>> left_out;
  double seconds = 0;  // the whole run, files included
  std::size_t peak_memory_bytes = 0;
};

// What a run has to do with the files of its folder; the checkpoint is gone at its end.
struct FilesOfRun {
  std::vector<std::filesystem::path> written;
  std::vector<std::filesystem::path> others;  // that a set of this name can have beside them
  std::filesystem::path checkpoint;
};
FilesOfRun files_of_run(const Config& config, const std::filesystem::path& folder);

// Does it all. Files appear all or none: an older set stands until the new one is on the disk, and
// the folder is locked meanwhile. Throws as generate_table, load_scene, read_table and
// require_extendable; InputError also for a checkpoint that is there without `resume` or is of
// another run, and where an input would be removed; IoError where the system refuses; CheckFailure
// where no entry has a finite fit, after which nothing is written. An Interrupted says where the
// checkpoint is. Of several ranks the first one alone has to do with files, warnings and costs.
RunReport make_table(const RunRequest& request, const RunContext& context);

}  // namespace ltc
