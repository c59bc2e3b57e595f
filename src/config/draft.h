// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A config as its file has it, before the axes are laid out.
#pragma once

#include "config/config.h"

namespace ltc::config {

// An axis as people write it: angles in degrees.
struct AxisSettings {
  double first = 0;
  double last = 1;
  int nodes = 8;
  Warp warp = Warp::linear;
};

struct Draft {
  Config config;  // all but its grid's axes, which stand beside it:
  AxisSettings alpha, lambda, theta_degrees, phi_degrees;
};

// The draft of a config, and the config of a draft whose axes are in order (first < last unless
// there is one node).
Draft draft_of(const Config& config);
Config config_of(const Draft& draft);

}  // namespace ltc::config
