// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What tells the reader of a lobe's picture where things are: angles, the mirror and the view.
#pragma once

#include <string>
#include <vector>

#include "picture/panel.h"
#include "report/lobe_density.h"

namespace ltc {

// Rings of equal elevation over the hemisphere, degrees along the edges of a zoomed window, and
// crosses at the mirror direction.
std::vector<picture::Overlay> window_marks(const LobeWindow& window, const Lobe& lobe);

// One line: the projection and what the marks are.
std::string window_words(const LobeWindow& window);

}  // namespace ltc
