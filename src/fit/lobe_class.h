// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What kind of lobe one is, and so how much work its fit is.
#pragma once

#include "fit/lobe_frame.h"

namespace ltc {

// True where nothing needs to be fitted: the loss of the first-order P0 is less than the samples of
// a fit can tell from the best.
bool first_order_is_exact(const LobeFrame& frame);

// True for lobes of heavy tails with a larger roughness below 0.12. What an LTC misses of them is
// less than the noise of equally weighted samples, most of which is in the tails; near the horizon
// they have several minima besides, which only graded samples tell apart.
bool is_sharp(const LobeFrame& frame);

// True for what no table asks for by default: thinner than alpha_min, or nearer to the horizon than
// its last view, 89.991 degrees. Such lobes have several minima, and more work is done for them.
bool is_extreme(const LobeFrame& frame);

}  // namespace ltc
