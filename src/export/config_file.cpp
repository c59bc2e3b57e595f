// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/config_file.h"

#include "export/hdf5.h"

namespace ltc {

Config load_config_or_table(const std::optional<std::filesystem::path>& file,
                            std::span<const std::string> overrides) {
  if (file && file->extension() == ".h5")
    return parse_config(read_hdf5(*file).config, *file, overrides);
  return load_config(file, overrides);
}

}  // namespace ltc
