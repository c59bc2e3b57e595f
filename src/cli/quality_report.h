// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How validate writes the quality of a table.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "judge/quality_summary.h"

namespace ltc::cli {

std::string quality_text(const std::string& file, const QualityReport& quality,
                         const std::vector<ThresholdCheck>& thresholds);

// `file` is the table's, for commands. All figures, every query with its floor; null where there is
// no number.
nlohmann::ordered_json quality_json(const std::string& file, const QualityReport& quality,
                                    const std::vector<ThresholdCheck>& thresholds);

}  // namespace ltc::cli
