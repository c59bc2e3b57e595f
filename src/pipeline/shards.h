// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Parts of a table's fits that are made apart, each leaving a file, on machines that need not know
// of each other; and the fits of all of them, with which a run goes on (RunRequest::shards).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/run_context.h"
#include "fit/fit_journal.h"
#include "pipeline/run.h"

namespace ltc {

struct ShardReport {
  std::filesystem::path file;
  std::size_t fits = 0;     // of the shard
  std::size_t resumed = 0;  // of these, taken from its file
  double seconds = 0;
};

std::filesystem::path shard_file(const Config& config, const std::filesystem::path& folder,
                                 const Shard& shard);

// Fits a shard of what make_table(request) would fit, and leaves its file in the folder, where
// other shards may be at work; what is done of it while it works. Throws as make_table; InputError
// where nothing of the table is fitted entry by entry.
ShardReport make_shard(const RunRequest& request, const Shard& shard, const RunContext& context);

// The fits of all shards. Throws InputError that names each that is missing, incomplete, there
// twice or of another run; IoError for a file that cannot be opened. `resume_name` as in
// RunRequest.
FinishedFits merged_shards(const Config& config, const std::vector<bool>& needed,
                           const std::vector<std::filesystem::path>& files,
                           const std::string& resume_name);

// The config that the first of these files was made with, as TOML. Throws as read_shard_header.
std::string config_of_shards(const std::vector<std::filesystem::path>& files);

}  // namespace ltc
