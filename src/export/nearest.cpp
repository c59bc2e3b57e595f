// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/nearest.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/error.h"

namespace ltc {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

// Calls visit(flat index) for the up to eight entries one step along an axis from `flat`.
template <class Visit>
void for_each_neighbour(const std::array<std::size_t, 4>& shape, std::size_t flat, Visit visit) {
  std::size_t stride = 1;
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    const std::size_t index = flat / stride % shape[axis];
    if (index > 0)
      visit(flat - stride);
    if (index + 1 < shape[axis])
      visit(flat + stride);
    stride *= shape[axis];
  }
}

}  // namespace

// In waves: an entry at distance d takes the smallest source among its neighbours at distance d
// - 1. That is the smallest of all sources at distance d, for the first step of a shortest way to
// it ends at such a neighbour.
std::vector<std::size_t> nearest_fitted(const Table& table) {
  const auto shape = table.grid.shape();
  std::vector<std::size_t> source(table.grid.size(), none);
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
      for_each_neighbour(shape, from, [&](std::size_t to) {
        if (source[to] != none)
          return;
        if (reached[to] == none)
          next.push_back(to);
        reached[to] = std::min(reached[to], source[from]);
      });
    }
    for (const std::size_t entry : next)
      source[entry] = reached[entry];
    wave = std::move(next);
  }
  return source;
}

}  // namespace ltc
