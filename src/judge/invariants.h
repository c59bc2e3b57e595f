// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What holds for every sound table, whoever made it and however good its fits are.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/range.h"
#include "core/run_context.h"
#include "export/format.h"
#include "table/table.h"

namespace ltc {

// Largest values allowed, and the effort of the checks that sample; docs/validation.md says what
// each means and why it stands where it does.
struct InvariantLimits {
  double condition_number = 1e7;   // of M: its largest singular value over its smallest
  double zero = 0;                 // entries of S that equation (16) says are zero
  double upward_difference = 0;    // between values at theta = 0 that differ in phi alone
  double unit_length = 1e-6;       // of the third column of S, its length's deviation from 1
  double alignment_degrees = 0.1;  // by which the closed form would turn M further
  double half_error = no_limit;    // of the lobe, by rounding S to half precision
  double inverse_error = 0.01;     // of the lobe, by inverting M in single precision
  double below_horizon = 1;        // share of the lobe
  double albedo_error = 2e-4;      // of amplitude and Fresnel against fresh quadrature
  double loss_excess = 1.2;        // LobeMeasures::loss_excess
  double neighbour_excess = 1.3;   // LobeMeasures::neighbour_excess
  double neighbour_slack = 0;      // LobeEffort::slack
  int albedo_points = 16384;       // of the fresh quadrature
  int samples = 2048;              // of a lobe, for stored loss and neighbours
  int directions = 16;             // that they are projected on

  bool operator==(const InvariantLimits&) const = default;
};

struct InvariantResult {
  std::string name;     // "determinant", "condition number", …
  bool checked = true;  // false: there is no value; `reason` says why
  bool judged = true;   // false: the value is only told, for no limit is set; `reason` says why
  bool passed = true;   // true where it is not checked
  std::string reason;   // of what is not judged, in words
  double value = 0;     // the worst of all entries with values; NaN if an entry's is
  double limit = 0;
  bool at_most = true;               // the value must be at most the limit; false: above it
  std::vector<std::size_t> entries;  // that fail, flat, worst first
  std::size_t worst = 0;             // flat, the entry of `value`; only if `has_worst`
  bool has_worst = false;            // false: nothing to judge, or not a matter of entries
  std::string message;               // one line that names the worst entry; empty if passed
};

// "at most 0.1", "above 0"; "any" where the value is only told.
std::string allowed_text(const InvariantResult& result);

// Why a limit is not set that is for nodes which serve their own lobes alone.
std::string_view why_not_limited(const Table& table);

// All invariants, in the order of docs/validation.md, each judged over the entries that have values
// (skipped ones are none's business; failed ones are not finite). Never throws for what the table
// holds; Interrupted if a stop is asked for.
std::vector<InvariantResult> check_invariants(const Table& table, const InvariantLimits& limits,
                                              const RunContext& run,
                                              const TableContents& contents = {});

}  // namespace ltc
