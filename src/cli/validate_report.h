// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What validate tells of a table: text, JSON, and the one line that it fails with.
#pragma once

#include <string>
#include <vector>

#include "validate/invariants.h"

namespace ltc::cli {

struct ValidateReport {
  std::string file;
  Table table;
  std::vector<InvariantResult> invariants;
};

std::string report_text(const ValidateReport& report);
std::string report_json(const ValidateReport& report);  // with a line break at its end

// Names every check that failed, the first with its worst entry; empty if all passed.
std::string failure_text(const ValidateReport& report);

}  // namespace ltc::cli
