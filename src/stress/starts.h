// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Where the fits of a stress run start from: where the program itself does, and where nobody would.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "brdf/ggx.h"

namespace ltc {

enum class StressStart {
  // The program's own.
  solver_choice,  // none given
  first_order,
  moments,
  // Bad ones.
  identity,
  random,            // the moments' with noise of 0.4 times its entries
  rotation,          // uniform among all rotations: a clamped cosine turned anywhere
  scaled_down,       // 1e-6 times the moments': the same lobe
  scaled_up,         // 1e6 times, likewise
  narrowed,          // columns 0 and 1 of the moments' times 1e-6: a million times too narrow
  widened,           // times 1e6: all of the lobe along the horizon of its axis
  reflected,         // determinant < 0: the same lobe
  negated,           // determinant < 0: the lobe below the surface
  exchanged,         // columns 0 and 1 exchanged: the same lobe, its symmetry zeros misplaced
  nearly_singular,   // column 1 the same as column 0 but for 1e-9 of it
  singular,          // column 1 zero
  other_hemisphere,  // determinant > 0, the axis turned about
  not_a_number,
};

struct StressStartKind {
  StressStart start;
  const char* name;  // "first-order"
  bool own;          // the program itself starts there
};

// All of them, the program's own first.
std::span<const StressStartKind> stress_starts();

// M to start from; none where the solver shall choose. `seed` is that of what is random.
std::optional<Eigen::Matrix3d> start_matrix(StressStart start, const Lobe& lobe,
                                            std::uint64_t seed);

}  // namespace ltc
