// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// From the config that a table carries back to the command line that says the same.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ltc {

// The keys of `toml` whose values are not the defaults, as the overrides "key=value" of
// load_config, in the order of the file. Keys that are not known are left out; so is everything
// where the text is not TOML.
std::vector<std::string> overrides_of(std::string_view toml);

}  // namespace ltc
