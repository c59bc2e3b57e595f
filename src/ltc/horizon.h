// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What is done about the part of a lobe that lies below the surface's horizon, where GGX reflects
// nothing.
#pragma once

#include "core/enum_names.h"
#include "ltc/folded.h"

namespace ltc {

enum class HorizonMode {
  clipped,  // cut off and lost: the rest has less light than GGX reflects
  scaled,   // cut off, and the rest divided by its share: the distribution of what is above
};
constexpr EnumNames<HorizonMode, 2> enum_names(HorizonMode) {
  return {"horizon", {{{HorizonMode::clipped, "clipped"}, {HorizonMode::scaled, "scaled"}}}};
}

// What shares of a lobe above the horizon are multiplied by: 1, or 1 / (1 - share_below_horizon),
// at most 16: a lobe with less than a sixteenth above is no lobe of GGX, and what is left of it
// mostly noise. Throws as FoldedCosine does for a folded lobe.
inline constexpr double most_horizon_factor = 16;
double horizon_factor(const LtcLobe& lobe, HorizonMode mode);

}  // namespace ltc
