// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/config_file.h"

#include "config/config.h"
#include "export/hdf5.h"

namespace ltc {

std::string config_text(const std::filesystem::path& file) {
  return file.extension() == ".h5" ? read_hdf5(file).config : read_config(file);
}

}  // namespace ltc
