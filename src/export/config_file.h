// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A config from its own file, or from that of a table which it made.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "config/config.h"

namespace ltc {

// As load_config, but `file` may also be a table's .h5, whose config it then is. Throws as
// load_config and read_hdf5 do.
Config load_config_or_table(const std::optional<std::filesystem::path>& file,
                            std::span<const std::string> overrides);

}  // namespace ltc
