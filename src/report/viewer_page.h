// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A page in which tables are looked at: objects under area lights in WebGL 2, by the tables and by
// sampled GGX. It stands by itself, the tables within; its script and shaders are those of viewer/
// and shaders/glsl.
#pragma once

#include <span>
#include <string>

#include "table/table.h"

namespace ltc {

struct ViewedTable {
  std::string name;    // what the page calls it: its file
  const Table* table;  // with amplitude and Fresnel term (render/missing_albedo.h)
};

// Of one table, or of two to compare. Entries without values show the nearest that has some
// (export/nearest.h). Throws InputError for another number of tables, a table of another BRDF than
// GGX, the reference of the page, and one without any values.
std::string viewer_page(std::span<const ViewedTable> tables);

}  // namespace ltc
