// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What every whole table must fulfil, whoever made it.
#pragma once

#include <string>
#include <vector>

#include "table/table.h"

namespace ltc::test {

// One line a fault: an entry without values, or whose values are not finite; a determinant that is
// not positive; an entry that equation (16) says is zero and is not; theta = 0 not the same bits
// for all phi; a third column whose length is not 1 within 1e-6; an amplitude or Fresnel term
// outside (0, 1], or a Fresnel term above the amplitude. Only for tables without skipped entries.
std::vector<std::string> faults_of(const Table& table);

}  // namespace ltc::test
