// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/lobe_frame.h"

#include "brdf/lobe_model.h"
#include "table/storage.h"
#include "table/symmetry.h"

namespace ltc {

LobeFrame::LobeFrame(const Lobe& lobe)
    : lobe(lobe),
      omega_v(lobe.omega_v()),
      rotation(lobe.model->frame(lobe)),
      widths(lobe.model->widths(lobe)) {
  first_order = rotation.transpose() * lobe.model->first_order(lobe);
  first_order.col(2) = Eigen::Vector3d::UnitZ();  // exactly, by the definition of Q
}

Eigen::Matrix3d LobeFrame::to_matrix(const Eigen::Matrix3d& frame_matrix) const {
  return rotation * frame_matrix * widths.asDiagonal();
}

Eigen::Matrix3d LobeFrame::from_matrix(const Eigen::Matrix3d& matrix) const {
  return rotation.transpose() * matrix * widths.cwiseInverse().asDiagonal();
}

FreeEntries free_entries(const Lobe& lobe) {
  const auto zeros = symmetry_zeros(lobe.theta_radians, lobe.phi_radians);
  FreeEntries free;
  for (int entry = 0; entry < 9; ++entry)
    free[entry] = !zeros(entry / 3, entry % 3);
  return free;
}

}  // namespace ltc
