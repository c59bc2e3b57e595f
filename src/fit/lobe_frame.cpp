// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/lobe_frame.h"

#include <cmath>
#include <numbers>

#include "table/storage.h"

namespace ltc {

LobeFrame::LobeFrame(const GgxLobe& lobe)
    : lobe(lobe), omega_v(lobe.omega_v()), rotation(mirror_rotation(omega_v)) {
  Eigen::Matrix3d unscaled;
  unscaled.col(0) << 2 * omega_v.z(), 0, 2 * omega_v.x();
  unscaled.col(1) << 0, 2 * omega_v.z(), 2 * omega_v.y();
  unscaled.col(2) << -omega_v.x(), -omega_v.y(), omega_v.z();
  first_order = rotation.transpose() * unscaled;
  first_order.col(2) = Eigen::Vector3d::UnitZ();  // exactly, by the definition of Q
}

Eigen::Matrix3d LobeFrame::to_matrix(const Eigen::Matrix3d& frame_matrix) const {
  return rotation * frame_matrix * Eigen::Vector3d(lobe.alpha_x, lobe.alpha_y, 1).asDiagonal();
}

Eigen::Matrix3d LobeFrame::from_matrix(const Eigen::Matrix3d& matrix) const {
  return rotation.transpose() * matrix *
         Eigen::Vector3d(1 / lobe.alpha_x, 1 / lobe.alpha_y, 1).asDiagonal();
}

FreeEntries free_entries(const GgxLobe& lobe) {
  constexpr double tolerance = 1e-9;
  const bool upright = std::abs(lobe.theta_radians) < tolerance;
  const bool in_xz_plane = upright || std::abs(lobe.phi_radians) < tolerance;
  const bool in_yz_plane = upright || std::abs(lobe.phi_radians - std::numbers::pi / 2) < tolerance;
  const auto free = [&](int row, int column) {
    if (row == column)
      return true;
    const bool touches_x = row == 0 || column == 0, touches_y = row == 1 || column == 1;
    return !(in_xz_plane && touches_y) && !(in_yz_plane && touches_x);
  };
  FreeEntries entries;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      entries[3 * row + column] = free(row, column);
  return entries;
}

}  // namespace ltc
