// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "core/error.h"
#include "core/hdf5_file.h"
#include "core/hdf5_guard.h"
#include "core/version.h"
#include "core/write_file.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;

const std::string root = "/";

constexpr const char* way_out = "remove it to begin anew";

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw InputError(fmt::format("checkpoint {}: {}", path.string(), what));
}

// The fits as the file has them: arrays over rounds and the entries of which any fit is finished.
// What is not finished takes no room: a stop must not wait for gigabytes of it.
struct Arrays {
  std::vector<std::int32_t> entry;  // flat
  std::vector<double> matrix;       // row-major
  std::vector<double> loss;
  std::vector<std::int32_t> steps;
  std::vector<std::uint8_t> status;
};

Arrays to_arrays(const FinishedFits& fits) {
  Arrays arrays;
  for (const FitRound& round : fits.rounds)
    for (const auto& [flat, entry] : round.finished())
      arrays.entry.push_back(static_cast<std::int32_t>(flat));
  std::ranges::sort(arrays.entry);
  arrays.entry.erase(std::ranges::unique(arrays.entry).begin(), arrays.entry.end());
  for (const FitRound& round : fits.rounds)
    for (const std::int32_t flat : arrays.entry) {
      const FittedEntry entry = round[static_cast<std::size_t>(flat)];
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
          arrays.matrix.push_back(entry.matrix(row, column));
      arrays.loss.push_back(entry.loss);
      arrays.steps.push_back(entry.steps);
      arrays.status.push_back(static_cast<std::uint8_t>(entry.status));
    }
  return arrays;
}

// Throws InputError for an entry that no fit leaves behind.
FittedEntry entry_of(const Arrays& arrays, std::size_t i, const fs::path& path) {
  FittedEntry entry;
  for (std::size_t k = 0; k < 9; ++k)
    entry.matrix(static_cast<int>(k / 3), static_cast<int>(k % 3)) = arrays.matrix[9 * i + k];
  entry.loss = arrays.loss[i];
  entry.steps = arrays.steps[i];
  entry.status = static_cast<Status>(arrays.status[i]);
  if (entry.status > Status::failed || entry.status == Status::copied)
    refuse(path, fmt::format("dataset fit/status holds {}; allowed: 0, 1, 3 and 4; {}",
                             arrays.status[i], way_out));
  if (entry.steps < 0)
    refuse(path, fmt::format("dataset fit/steps holds {}; allowed: 0 and more; {}", entry.steps,
                             way_out));
  if (has_values(entry.status) && !entry.matrix.allFinite())
    refuse(path,
           fmt::format("dataset fit/matrix is not finite where a fit is finished; {}", way_out));
  return entry;
}

void require_entries(const std::vector<std::int32_t>& entries, std::size_t nodes,
                     const fs::path& path) {
  std::int64_t before = -1;
  for (const std::int32_t entry : entries) {
    if (entry <= before || static_cast<std::size_t>(entry) >= nodes)
      refuse(path, fmt::format("dataset fit/entry holds {} after {}; allowed: rising, up to {}; {}",
                               entry, before, nodes - 1, way_out));
    before = entry;
  }
}

std::vector<std::uint8_t> flags_of(const std::vector<bool>& needed) {
  return {needed.begin(), needed.end()};
}

void require_format(const Hdf5Input& file, const std::string& expected, const fs::path& path) {
  if (const std::string format = file.text(root, "format"); format != expected)
    refuse(path, fmt::format("attribute format is \"{}\"; allowed: \"{}\"{}", format, expected,
                             expected == checkpoint_format ? fmt::format("; {}", way_out) : ""));
  if (const std::int64_t version = file.integer(root, "format_version");
      version != checkpoint_format_version)
    refuse(path, fmt::format("attribute format_version is {}; allowed: {}; {}", version,
                             checkpoint_format_version, way_out));
}

Shard shard_in(const Hdf5Input& file, const fs::path& path) {
  const std::int64_t number = file.integer(root, "shard"), count = file.integer(root, "shards");
  if (number < 1 || number > count || count > most_shards)
    refuse(path, fmt::format("of shard {} of {}; allowed: 1 to their number, up to {}; {}", number,
                             count, most_shards, way_out));
  return {static_cast<int>(number), static_cast<int>(count)};
}

void require_same_shard(const Hdf5Input& file, const Shard& shard, const fs::path& path) {
  if (const Shard found = shard_in(file, path);
      found.number != shard.number || found.count != shard.count)
    refuse(path, fmt::format("of shard {} of {}; expected {} of {}; {}", found.number, found.count,
                             shard.number, shard.count, way_out));
}

ShardHeader read_shard_header_unguarded(const fs::path& path) {
  const Hdf5Input file(path);
  require_format(file, shard_format, path);
  return {shard_in(file, path), file.text(root, "config")};
}

// Fits of another program, config or set of entries would make a table that no run makes.
void require_same_run(const Hdf5Input& file, const Config& config, const std::vector<bool>& needed,
                      const fs::path& path) {
  if (const std::string made_by = file.text(root, "generator"); made_by != generator())
    refuse(path, fmt::format("made by {}, this is {}; go on with that, or {}", made_by, generator(),
                             way_out));
  if (const auto difference = first_difference(config, file.text(root, "config"), path))
    refuse(path,
           fmt::format("made with {} = {}, now it is {}; go on with its value, or {}",
                       difference->key, difference->other.empty() ? "nothing" : difference->other,
                       difference->value, way_out));
  if (file.values<std::uint8_t>("needed", {needed.size()}) != flags_of(needed))
    refuse(path,
           fmt::format(
               "made for other entries; go on with its scene and the table that it extends, or {}",
               way_out));
}

}  // namespace

void write_checkpoint(const Config& config, const std::vector<bool>& needed,
                      const FinishedFits& fits, const fs::path& path,
                      const std::optional<Shard>& shard) {
  const Arrays arrays = to_arrays(fits);
  const std::size_t rounds = fits.rounds.size(), listed = arrays.entry.size();
  Hdf5Output file(path.string());
  file.text(root, "format", shard ? shard_format : checkpoint_format);
  file.number(root, "format_version", std::int32_t{checkpoint_format_version});
  file.text(root, "generator", generator());
  file.text(root, "config", to_toml(config));
  if (shard) {
    file.number(root, "shard", std::int32_t{shard->number});
    file.number(root, "shards", std::int32_t{shard->count});
  }
  file.values<std::uint8_t>("needed", {needed.size()}, flags_of(needed));
  file.group("fit");
  file.values<std::int32_t>("fit/entry", {listed}, arrays.entry);
  file.values<double>("fit/matrix", {rounds, listed, 3, 3}, arrays.matrix);
  file.values<double>("fit/loss", {rounds, listed}, arrays.loss);
  file.values<std::int32_t>("fit/steps", {rounds, listed}, arrays.steps);
  file.values<std::uint8_t>("fit/status", {rounds, listed}, arrays.status);
  write_file(path, file.finish());
}

FinishedFits read_checkpoint_unguarded(const Config& config, const std::vector<bool>& needed,
                                       const fs::path& path, const std::optional<Shard>& shard) {
  const Hdf5Input file(path);
  require_format(file, shard ? shard_format : checkpoint_format, path);
  if (shard)
    require_same_shard(file, *shard, path);
  require_same_run(file, config, needed, path);
  const std::size_t rounds = 1 + static_cast<std::size_t>(sweep_count(config.fit));
  const std::vector<std::size_t> shape = file.shape("fit/entry");
  const std::size_t listed = shape.empty() ? 0 : shape.front();
  const Arrays arrays{file.values<std::int32_t>("fit/entry", {listed}),
                      file.values<double>("fit/matrix", {rounds, listed, 3, 3}),
                      file.values<double>("fit/loss", {rounds, listed}),
                      file.values<std::int32_t>("fit/steps", {rounds, listed}),
                      file.values<std::uint8_t>("fit/status", {rounds, listed})};
  require_entries(arrays.entry, needed.size(), path);
  FinishedFits fits;
  for (std::size_t round = 0; round < rounds; ++round) {
    FitRound& entries = fits.rounds.emplace_back(needed.size());
    for (std::size_t i = 0; i < listed; ++i)
      entries.set(static_cast<std::size_t>(arrays.entry[i]),
                  entry_of(arrays, round * listed + i, path));
  }
  return fits;
}

FinishedFits read_checkpoint(const Config& config, const std::vector<bool>& needed,
                             const fs::path& path, const std::optional<Shard>& shard) {
  require_harmless(path, [&] { read_checkpoint_unguarded(config, needed, path, shard); });
  return read_checkpoint_unguarded(config, needed, path, shard);
}

ShardHeader read_shard_header(const fs::path& path) {
  require_harmless(path, [&] { read_shard_header_unguarded(path); });
  return read_shard_header_unguarded(path);
}

}  // namespace ltc
