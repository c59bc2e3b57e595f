// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Two tables, lobe against lobe: which is nearer to GGX, and how far they are from each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/run_context.h"
#include "judge/held_out.h"
#include "table/table.h"

namespace ltc {

struct CompareSettings {
  std::size_t samples = 16384;  // weighted lattice samples of the lobe, and cosine samples
  std::size_t directions = 64;  // projection directions, evenly spread and turned at random
  std::uint64_t seed = 20220712;
};

inline constexpr double not_compared = std::numeric_limits<double>::quiet_NaN();

// One entry of both tables. A figure is NaN where a table lacks what it needs: the entry, or the
// amplitude and Fresnel terms. M and s M R, with s > 0 and R a rotation or reflection about z, are
// one lobe; so the matrix of B is first brought as near as it gets to that of A (align_to).
struct EntryComparison {
  // Sliced-Wasserstein distances to the GGX lobe, held out: on samples and directions that no fit
  // has seen, the same for both lobes.
  double loss_a = 0, loss_b = 0;
  double spread = 0;  // of the GGX lobe, the scale that losses are judged by
  // Between the two LTC, by the same samples, paired: 0 for two matrices of one lobe.
  double distance = not_compared;
  // Largest of an entry, third columns of unit length; of a folded lobe's matrix as it stands, for
  // creases turn with R.
  double matrix_difference = not_compared;
  double amplitude_difference = not_compared, fresnel_difference = not_compared;  // absolute

  double ratio() const { return loss_a / loss_b; }
  double relative_distance() const { return distance / spread; }
};

// What the matrices of A and B are to a lobe and to each other; no terms.
EntryComparison compare_lobes(const Lobe& lobe, const LtcLobe& a, const LtcLobe& b,
                              HeldOutJudge& judge);

// Throws InputError, naming the difference, unless the two grids are the same.
void require_same_grid(const Grid& a, const Grid& b);

// One comparison a node. Lobes that are the same in both tables to the last bit, as symmetry makes
// them (theta = 0, alpha = 0), are judged once. Throws InputError when the grids differ.
std::vector<EntryComparison> compare_tables(const Table& a, const Table& b,
                                            const CompareSettings& settings, const RunContext& run);

}  // namespace ltc
