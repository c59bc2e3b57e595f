// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Pictures of each kind from synthetic data, as the program makes them from real data.
#pragma once

#include "picture/chart.h"
#include "picture/heat_map.h"
#include "picture/panel.h"

namespace ltc::picture::test {

// Run time against error: two families of settings, the published method far off, a frontier.
Chart frontier_chart();

// A falling loss with a noisy one beside it.
Chart loss_chart();

// A ratio over alpha, lambda, theta, phi with a bad entry, one without a value, and two marks.
// Sizes are tile rows, tile columns, rows, columns.
TiledMap ratio_map(const std::array<std::size_t, 4>& sizes = {8, 8, 8, 8});

// Two lobes on the disc of directions and their signed difference.
PanelRow lobe_row();

}  // namespace ltc::picture::test
