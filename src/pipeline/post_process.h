// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What happens to one entry's matrix between its alignment and the table.
#pragma once

#include <Eigen/Core>

#include "brdf/ggx.h"
#include "table/storage.h"

namespace ltc {

struct PostProcessed {
  Eigen::Matrix3d stored;  // S of the storage, third column of unit length, every entry a float
  double zeroed = 0;       // largest |entry| that equation (16) set to zero
};

// Equation (16) and a unit third column, and from M to what a table stores. `aligned` is M after
// alignment; throws as normalise does.
PostProcessed post_process(const Lobe& lobe, Storage storage, const Eigen::Matrix3d& aligned);

}  // namespace ltc
