// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What generate tells at its end.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/generate.h"

namespace ltc::cli {

struct RunReport {
  GenerateReport generate;
  std::size_t needed = 0;   // entries that the scene needs; all without a scene
  std::size_t added = 0;    // of these, not in the table that is extended
  bool extends = false;     // whether one is
  std::size_t resumed = 0;  // fits taken from a checkpoint
  std::string half;         // what 16-bit textures cost, in words; empty: none were written
  std::vector<std::filesystem::path>
      removed;                // older files of the set that this run does not write
  bool npy_left_out = false;  // asked for, but the grid is not the paper's
  double seconds = 0;         // the whole run, files included
  std::size_t peak_memory_bytes = 0;
  std::vector<std::filesystem::path> files;
  // The commands that look into an entry, up to the entry's indices.
  std::string fit_command;     // the fit that it had; empty where not all entries are of this run
  std::string stored_command;  // what the file holds; empty where that is the fit
};

inline constexpr std::size_t worst_count = 5;  // entries that are named

std::string summary_text(const Table& table, const RunReport& report);
std::string summary_json(const Table& table, const RunReport& report);

}  // namespace ltc::cli
