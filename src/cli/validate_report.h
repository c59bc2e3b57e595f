// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What validate tells of a table: text, JSON, and the one line that it fails with.
#pragma once

#include <string>

#include "report/validation_page.h"

namespace ltc::cli {

std::string report_text(const Validation& report);
std::string report_json(const Validation& report);  // with a line break at its end

// Names every check that failed, the first with its worst entry; empty if all passed.
std::string failure_text(const Validation& report);

}  // namespace ltc::cli
