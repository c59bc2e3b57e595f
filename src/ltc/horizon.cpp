// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "ltc/horizon.h"

namespace ltc {

double horizon_factor(const LtcLobe& lobe, HorizonMode mode) {
  if (mode == HorizonMode::clipped)
    return 1;
  const double above = 1 - share_below_horizon(lobe);
  return above > 0 ? 1 / above : 1;
}

}  // namespace ltc
