// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/cost_text.h"

#include <fmt/format.h>

#include "export/format.h"

namespace ltc::cli {
namespace {

// Two cores make so many in some ten seconds with the default solver.
constexpr std::size_t most_quick_fits = 10000;

// Uncompressed.
std::size_t file_bytes(const Config& config) {
  std::size_t bytes = 0;
  for (const Format& format : formats())
    if (format.is_written(config))
      bytes += format.entry_bytes / (write_options(format, config.output).half ? 2 : 1);
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
  return fmt::format("generate: {}{} fits for {} entries{}{}; about {} of memory and {} of files\n",
                     cost.interpolated ? "about " : "", cost.fits, config.grid.size(),
                     cost.interpolated ? ", the others interpolated" : "", refinement,
                     gigabytes(cost.memory_bytes), gigabytes(file_bytes(config)));
}

}  // namespace ltc::cli
