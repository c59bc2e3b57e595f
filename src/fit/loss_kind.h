// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#pragma once

#include "core/enum_names.h"

namespace ltc {

// How the distribution of an LTC along a direction is found: in closed form (fit/arc_model.h), or on
// samples (fit/quantile_model.h), which folded lobes and those that a scaled horizon cuts take in
// any case.
enum class LossKind { arcs, samples };
constexpr EnumNames<LossKind, 2> enum_names(LossKind) {
  return {"loss", {{{LossKind::arcs, "arcs"}, {LossKind::samples, "samples"}}}};
}

}  // namespace ltc
