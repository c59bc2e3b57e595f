// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Whether a config asks of a BRDF what it has.
#pragma once

#include "config/config.h"

namespace ltc {

// Throws InputError for a grid with lobes that its model has no values for.
void require_lobes(const Grid& grid);

// Throws InputError, naming the key, for such a grid, and for a field, folds or a storage in the
// mirror direction's frame of a model whose lobes are not about that direction
// (LobeModel::about_mirror).
void require_model(const Config& config);

}  // namespace ltc
