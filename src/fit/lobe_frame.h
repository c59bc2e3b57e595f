// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The variables of the fit: M seen from the mirror direction and divided by the roughness.
//
// With A = diag(alpha_x, alpha_y, 1) and Q the least rotation from z to the mirror direction m of
// the view, the fit works on
//     P = Q^T M A^-1,        M = Q P A.
// In these variables every lobe looks alike: to first order in the slopes P is
//     P0 = Q^T [ (2vz, 0, 2vx) | (0, 2vz, 2vy) | m ],
// whose third column is e_z (see first_order_start), and directions are expressed by their offset
// from m, g = Q^T omega - e_z, which keeps its relative precision however narrow the lobe is. A
// model whose lobes are not about the mirror direction gives Q and A of its own (lobe_model.h).
#pragma once

#include <Eigen/Core>
#include <array>

#include "brdf/ggx.h"

namespace ltc {

struct LobeFrame {
  explicit LobeFrame(const Lobe& lobe);

  Eigen::Matrix3d to_matrix(const Eigen::Matrix3d& frame_matrix) const;  // P to M
  Eigen::Matrix3d from_matrix(const Eigen::Matrix3d& matrix) const;      // M to P

  Lobe lobe;
  Eigen::Vector3d omega_v;
  Eigen::Matrix3d rotation;     // Q
  Eigen::Vector3d widths;       // A's diagonal
  Eigen::Matrix3d first_order;  // P0
};

// Which entries of M (and of P alike) symmetry leaves free, equation (16) of Aakash et al. 2022:
// true where an entry may differ from zero. Row-major.
using FreeEntries = std::array<bool, 9>;
FreeEntries free_entries(const Lobe& lobe);

}  // namespace ltc
