// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What is demanded of a table: thresholds and efforts, from config/validate.toml.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/config.h"
#include "judge/invariants.h"
#include "judge/quality.h"
#include "judge/quality_summary.h"

namespace ltc {

// One member a section of the file.
struct ValidateSettings {
  InvariantLimits invariants;
  QualitySettings quality;
  QualityThresholds thresholds;  // in section quality too
  std::set<std::string> said;    // the keys that a file or an override has set
};

// What is demanded of a table that was refined, config/validate-refined.toml: less error between
// the nodes, but nodes that are no longer the best for their own lobes.
ValidateSettings settings_for_refined_tables();

// Those limits that the table's own precision and history allow: of a table of which it is not
// known whether it was refined, the laxer of both; 16-bit values are off by their rounding.
ValidateSettings settings_for(const Table& table);

// `settings`, then what `file` says if there is one, then the overrides in order, as load_config.
// Throws InputError and IoError as load_config does.
ValidateSettings load_validate_settings(const std::optional<std::filesystem::path>& file,
                                        std::span<const std::string> overrides,
                                        ValidateSettings settings = {},
                                        std::string_view overrides_from = "override");

// What can be set, in the order of the file; validate_settings.cpp is where keys are added.
std::vector<ConfigKey> validate_keys();

}  // namespace ltc
