// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/cost_text.h"

#include <fmt/format.h>

#include "export/npy.h"

namespace ltc::cli {
namespace {

// Two cores make so many in some ten seconds with the default solver.
constexpr std::size_t most_quick_fits = 10000;

// Of an entry in each kind of file: HDF5 has nine matrix values, two albedos, a loss, a status and
// the steps; EXR, uncompressed, three images of four channels; NPY the matrix alone.
std::size_t file_bytes(const Config& config) {
  const OutputSettings& output = config.output;
  std::size_t bytes = 0;
  if (output.hdf5)
    bytes += 12 * 4 + 3;
  if (output.exr)
    bytes += 12 * (output.exr_half ? 2 : 4);
  if (output.npy && npy_can_hold(config.grid))
    bytes += 9 * 4;
  return bytes * config.grid.size();
}

std::string gigabytes(std::size_t bytes) {
  return fmt::format("{:.2g} GB", static_cast<double>(bytes) / 1e9);
}

}  // namespace

std::string cost_text(const Config& config, const Cost& cost) {
  if (cost.fits <= most_quick_fits)
    return "";
  const std::string refinement =
      cost.queries > 0 ? fmt::format(", a refinement on {} look-ups", cost.queries) : "";
  return fmt::format("generate: {} fits for {} entries{}; about {} of memory and {} of files\n",
                     cost.fits, config.grid.size(), refinement, gigabytes(cost.memory_bytes),
                     gigabytes(file_bytes(config)));
}

}  // namespace ltc::cli
