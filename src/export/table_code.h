// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a shader is told of a table: the struct LtcTable of shaders/glsl/ltc_table.glsl as a
// constant.
#pragma once

#include <string>

#include "export/field_code.h"
#include "table/grid.h"
#include "table/storage.h"

namespace ltc {

// `constant LTC_TABLE` in GLSL, HLSL or WGSL, with a comment; throws InputError for others.
std::string table_constant(const Grid& grid, Storage storage, CodeLanguage language,
                           const Creases& creases = {});

}  // namespace ltc
