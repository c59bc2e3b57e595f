// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a table holds for one lobe, judged as a fit of that lobe is.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/run_context.h"
#include "pipeline/fit_one.h"
#include "table/table.h"

namespace ltc {

// A node that a look-up takes from.
struct TakenNode {
  std::size_t flat = 0;
  double weight = 0;
  double relative_loss = 0;  // of the node's matrix to its own lobe, held out, over the spread
};

// Matrices and terms are those of the table; NaN where its file does not hold them.
struct StoredLobe {
  Lobe lobe;
  std::optional<std::size_t> entry;  // of the table's grid, where it is asked for as one
  std::vector<TakenNode> nodes;      // of a look-up, largest weight first; none for an entry
  bool within_axes = true;           // otherwise the look-up was clamped to them
  Eigen::Matrix3d stored;            // of an entry
  Eigen::Matrix3d matrix;            // M
  Fold fold;                         // of folded lobes, with their creases
  Creases creases;
  Albedo albedo;
  double stated_loss = 0;    // of an entry
  double held_out_loss = 0;  // of `matrix`, by samples that no fit has seen
  LobeFit floor;             // an LTC fitted to this very lobe (floor_fit_settings)

  LtcLobe ltc() const { return {matrix, fold, creases}; }
};

// Entry `flat` of the table as it is stored. Throws InputError, naming the entry, where it has no
// values; Interrupted.
StoredLobe stored_entry(const Table& table, std::size_t flat, const RunContext& run);

// What a renderer gets for the lobe: the look-up of table/lookup.h. Throws InputError, naming the
// first entry that the look-up needs and that has no values; Interrupted.
StoredLobe stored_query(const Table& table, const Lobe& lobe, const RunContext& run);

}  // namespace ltc
