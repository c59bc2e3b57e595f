// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/nearest.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/error.h"

namespace ltc {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

}  // namespace

// In waves: an entry at distance d takes the smallest source among its neighbours at distance d
// - 1. That is the smallest of all sources at distance d, for the first step of a shortest way to
// it ends at such a neighbour.
std::vector<std::size_t> nearest_fitted(const Table& table) {
  std::vector<std::size_t> source(table.grid.size(), none);
  if (std::ranges::all_of(table.status, has_values)) {
    std::iota(source.begin(), source.end(), std::size_t{0});
    return source;
  }
  std::vector<std::size_t> wave;
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (has_values(table.status[i])) {
      source[i] = i;
      wave.push_back(i);
    }
  }
  if (wave.empty())
    throw InputError("every entry of the table is skipped or failed; textures need at least one");
  std::vector<std::size_t> reached(source.size(), none);  // the next wave's sources, kept apart
  while (!wave.empty()) {
    std::vector<std::size_t> next;
    for (const std::size_t from : wave) {
      for (const std::size_t to : table.grid.neighbours(from)) {
        if (source[to] != none)
          continue;
        if (reached[to] == none)
          next.push_back(to);
        reached[to] = std::min(reached[to], source[from]);
      }
    }
    for (const std::size_t entry : next)
      source[entry] = reached[entry];
    wave = std::move(next);
  }
  return source;
}

}  // namespace ltc
