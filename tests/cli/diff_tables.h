// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Small tables to compare, and how to have the program do so in no time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "judge/compare.h"
#include "table/synthetic.h"

namespace ltc::test {

inline const std::vector<std::string> quick = {"--samples", "256",       "--directions",
                                               "4",         "--queries", "16"};

inline CompareSettings quick_settings() {
  CompareSettings settings;
  settings.samples = 256;
  settings.directions = 4;
  return settings;
}

inline std::vector<std::string> diff(const std::filesystem::path& a, const std::filesystem::path& b,
                                     std::vector<std::string> more = {}) {
  std::vector<std::string> arguments = {"diff", a.string(), b.string()};
  arguments.insert(arguments.end(), quick.begin(), quick.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

inline Table example() {
  return testing::synthetic_table(testing::uneven_grid(), Storage::matrix);
}

// alpha 0.1 seen from above, where the example's matrix is nearly the best: the one that is named
// last in the file's order.
inline constexpr NodeIndex damaged_node{0, 1, 0, 2};

inline Table damaged_example() {
  Table table = example();
  const std::size_t flat = table.grid.flat(damaged_node);
  Eigen::Matrix3d matrix = table.stored_at(flat);
  matrix.col(0) *= 20;
  table.set_stored(flat, matrix);
  return table;
}

}  // namespace ltc::test
