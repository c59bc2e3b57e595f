// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Amplitude and Fresnel term of a field: least squares to the integrals of many lobes.
#pragma once

#include <vector>

#include "core/run_context.h"
#include "field/field.h"
#include "refine/field_fit.h"

namespace ltc {

// Adds terms of `amplitude` and `view_cosine` out of a pool, `count` together, to the field. The
// lobes are folded. Coefficients are rounded to halves where `half`. Throws Interrupted.
void fit_albedo(const std::vector<Lobe>& lobes, const std::vector<FieldTerm>& pool,
                std::size_t count, bool half, const RunContext& run, Field& field);

// Mean and largest errors over folded lobes, into the report.
void note_albedo_errors(const std::vector<Lobe>& lobes, const Field& field, const RunContext& run,
                        FieldReport& report);

}  // namespace ltc
