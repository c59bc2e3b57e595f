// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Amplitude and Fresnel term for tables whose file holds matrices alone (NPY).
#pragma once

#include "table/table.h"

namespace ltc {

// Integrates both (brdf/albedo.h) for every entry that has values but lacks either.
void fill_missing_albedo(Table& table);

}  // namespace ltc
