// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The file that keeps the finished fits of a run that is not, and of a shard that is or is not:
// docs/files.md says what lies where.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "fit/fit_journal.h"

namespace ltc {

// The `format` and `format_version` attributes of checkpoints.
inline constexpr const char* checkpoint_format = "ltc-checkpoint";
inline constexpr int checkpoint_format_version = 2;
// The `format` of those of a shard.
inline constexpr const char* shard_format = "ltc-shard";

// Writes the file whole or not at all, bit exact. `needed` says which entries the run makes, of
// which a shard is a part. Throws IoError where the system refuses.
void write_checkpoint(const Config& config, const std::vector<bool>& needed,
                      const FinishedFits& fits, const std::filesystem::path& path,
                      const std::optional<Shard>& shard = {});

// The fits that the file keeps, for a run of `config` that makes the entries `needed`. Throws
// IoError for a file that cannot be opened; InputError, naming the file, for one that is no
// checkpoint, is damaged, or belongs to another version of the program, to a config in which
// another key than those of [output] differs (it is named), to other needed entries, or to another
// shard.
FinishedFits read_checkpoint(const Config& config, const std::vector<bool>& needed,
                             const std::filesystem::path& path,
                             const std::optional<Shard>& shard = {});

// Which shard a file is of, and the config that it was made with, as TOML. Throws IoError for a
// file that cannot be opened; InputError for one that is none of a shard, or damaged.
struct ShardHeader {
  Shard shard;
  std::string config;
};
ShardHeader read_shard_header(const std::filesystem::path& path);

// The same without the guard of export/hdf5_guard.h: damaged files can crash the process. For
// fuzzers, which learn nothing of what happens in another process.
FinishedFits read_checkpoint_unguarded(const Config& config, const std::vector<bool>& needed,
                                       const std::filesystem::path& path,
                                       const std::optional<Shard>& shard = {});

}  // namespace ltc
