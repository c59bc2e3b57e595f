// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/post_process.h"

#include "postprocess/normalise.h"
#include "postprocess/symmetry.h"

namespace ltc {

PostProcessed post_process(const Lobe& lobe, Storage storage, const Eigen::Matrix3d& aligned) {
  Eigen::Matrix3d matrix = aligned;
  PostProcessed result;
  result.zeroed = enforce_symmetry(lobe.theta_radians, lobe.phi_radians, matrix);
  result.stored = normalise(storage, stored_from_matrix(storage, matrix, lobe));
  return result;
}

}  // namespace ltc
