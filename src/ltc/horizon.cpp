// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "ltc/horizon.h"

#include <algorithm>

namespace ltc {

double horizon_factor(const LtcLobe& lobe, HorizonMode mode) {
  if (mode == HorizonMode::clipped)
    return 1;
  return 1 / std::max(1 - share_below_horizon(lobe), 1 / most_horizon_factor);
}

}  // namespace ltc
