// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The effective configuration of a run: defaults, then a TOML file, then key=value overrides.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/output_settings.h"
#include "fit/settings.h"
#include "refine/field_settings.h"
#include "refine/refine_settings.h"
#include "table/grid.h"
#include "table/storage.h"

namespace ltc {

struct Config {
  Storage storage = Storage::matrix;
  Grid grid = Grid::paper();
  FitSettings fit;
  RefineSettings refine;
  FieldSettings field;
  OutputSettings output;
};

// The defaults, then what `file` says if there is one, then the overrides in order, each
// "key=value": the value as in TOML, or a bare string where that is not TOML. Throws InputError for
// an unknown key, a wrong type, a value out of range or broken syntax (one line: where it was
// said, the key, the value, what is allowed), IoError for a file that cannot be read. Messages say
// `overrides_from` where an override said it, such as an option's name.
Config load_config(const std::optional<std::filesystem::path>& file,
                   std::span<const std::string> overrides,
                   std::string_view overrides_from = "override");

// The text of a config's file, which parse_config then reads. Throws as load_config.
std::string read_config(const std::filesystem::path& file);

// The same with the text of a config that is at hand, such as the one in a table's file; `source`
// stands in messages for the file.
Config parse_config(std::string_view text, const std::filesystem::path& source,
                    std::span<const std::string> overrides,
                    std::string_view overrides_from = "override");

// Every key with its value, as TOML that load_config reads back to the same Config, bit for bit.
// (To the last bit only if the angles are those of some number of degrees, as those of every config
// that load_config returns are.)
std::string to_toml(const Config& config);

// A key of which a config and a text disagree, and its values as TOML; `other` is empty where the
// text has none.
struct KeyDifference {
  std::string key, value, other;
};

// The first key outside of [output], in the order of the file, whose value in `toml` is not that of
// `config`: what would make other fits. `toml` is what to_toml once gave; throws InputError naming
// `source` if it is no TOML at all.
std::optional<KeyDifference> first_difference(const Config& config, const std::string& toml,
                                              const std::filesystem::path& source);

// What can be configured, in the order of the file; see src/config/registry.cpp, where keys are
// added.
struct ConfigKey {
  std::string name;           // dotted: "fit.sgd.steps"
  std::string allowed;        // "a whole number in [1, 10000000]"
  std::string summary;        // one line
  std::string default_value;  // as TOML
};
std::vector<ConfigKey> config_keys();

}  // namespace ltc
