// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Fitted entries compared bit for bit; those that are skipped have nothing to compare.
#pragma once

#include <cstring>
#include <vector>

#include "fit/fit_journal.h"
#include "fit/fit_table.h"

namespace ltc::test {

inline bool same_bits(const FittedEntry& a, const FittedEntry& b) {
  if (a.status == Status::skipped && b.status == Status::skipped)
    return true;
  return std::memcmp(a.matrix.data(), b.matrix.data(), sizeof(double) * 9) == 0 &&
         std::memcmp(&a.loss, &b.loss, sizeof(double)) == 0 && a.steps == b.steps &&
         a.status == b.status;
}

// Of vectors or rounds.
template <typename Entries>
bool same_bits(const Entries& a, const Entries& b) {
  if (a.size() != b.size())
    return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!same_bits(a[i], b[i]))
      return false;
  return true;
}

}  // namespace ltc::test
