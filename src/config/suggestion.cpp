// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "config/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace ltc::config {
namespace {

// How many letters must change, come or go to make one word of the other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string suggestion(std::string_view unknown, std::span<const std::string> known,
                       std::string_view otherwise) {
  const auto last_word = [](std::string_view name) { return name.substr(name.rfind('.') + 1); };
  const auto distance = [&](std::string_view name) {
    // The right word in a wrong section is near too: fit.steps for fit.sgd.steps.
    return std::min(edit_distance(name, unknown),
                    1 + edit_distance(last_word(name), last_word(unknown)));
  };
  const std::string& nearest =
      *std::min_element(known.begin(), known.end(),
                        [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  if (distance(nearest) <= std::max<std::size_t>(2, unknown.size() / 4))
    return fmt::format("; did you mean {}?", nearest);
  return fmt::format("; {}", otherwise);
}

}  // namespace ltc::config
