// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "config/overrides.h"

#include <toml++/toml.h>

#include "config/config.h"
#include "config/toml_file.h"

namespace ltc {

std::vector<std::string> overrides_of(std::string_view toml) {
  toml::table said;
  try {
    said = toml::parse(toml);
  } catch (const toml::parse_error&) {
    return {};
  }
  std::vector<std::string> overrides;
  for (const ConfigKey& key : config_keys())
    if (const auto node = said.at_path(key.name)) {
      const std::string value = config::toml_of(config::value_of(*node.node()));
      if (value != key.default_value)
        overrides.push_back(key.name + "=" + value);
    }
  return overrides;
}

}  // namespace ltc
