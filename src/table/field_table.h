// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A field as a table: its values at the nodes of a grid.
#pragma once

#include "core/run_context.h"
#include "table/table.h"

namespace ltc {

// All entries of the grid from the field, of the storage's scale, as `fitted`; losses are NaN.
// Of a field of one material, those of other roughnesses are `skipped`. Of a folded field the
// storage is `folded`, whatever is asked for. The
// grid's alpha_min and BRDF are the field's. The result has the field too, so that look-ups are
// still the field's: without it, `.field.reset()`, it is a table that is interpolated.
// Throws InputError for storage inverse where the grid is not isotropic.
Table table_of_field(const Field& field, Grid grid, Storage storage, const RunContext& run = {});

}  // namespace ltc
