// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a run will cost, in a line for who may not want to wait for it.
#pragma once

#include <string>

#include "config/config.h"
#include "pipeline/generate.h"

namespace ltc::cli {

// "generate: 16011073 fits …\n"; empty for what takes some seconds.
std::string cost_text(const Config& config, const Cost& cost);

}  // namespace ltc::cli
