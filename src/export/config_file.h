// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A config from its own file, or from that of a table which it made.
#pragma once

#include <filesystem>
#include <string>

namespace ltc {

// The TOML of a config file, or of the config in a table's .h5. Throws as read_config and
// read_hdf5.
std::string config_text(const std::filesystem::path& file);

}  // namespace ltc
