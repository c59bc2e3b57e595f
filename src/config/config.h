// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The effective configuration of a run: defaults, then a TOML file, then --set key=value.
#pragma once

#include <string>

#include "fit/settings.h"
#include "table/grid.h"
#include "table/storage.h"

namespace ltc {

struct OutputSettings {
  std::string name = "ltc";  // files are <name>.h5, <name>.0.exr, …, <name>.npy
  bool hdf5 = true;
  bool exr = true;
  bool npy = true;
  bool exr_half = false;  // 16-bit textures instead of 32-bit
};

struct Config {
  std::string brdf = "ggx";
  Storage storage = Storage::matrix;
  Grid grid = Grid::paper();
  FitSettings fit;
  OutputSettings output;
};

}  // namespace ltc
