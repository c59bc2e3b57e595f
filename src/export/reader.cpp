// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/reader.h"

#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "export/exr.h"
#include "export/hdf5.h"
#include "export/npy.h"

namespace ltc {

Table read_table(const std::filesystem::path& path, std::optional<Layout> layout) {
  if (path.extension() == ".h5")
    return read_hdf5(path);
  if (path.extension() == ".npy")
    return read_npy(path, layout);
  const std::string name = path.string();
  for (int index = 0; index < 3; ++index)
    if (const std::string suffix = fmt::format(".{}.exr", index); name.ends_with(suffix))
      return read_exr(name.substr(0, name.size() - suffix.size()));
  throw InputError(
      fmt::format("{}: no suffix of a table; allowed: .h5, .npy, .0.exr, .1.exr, .2.exr", name));
}

TableContents contents_of(const std::filesystem::path& path) {
  return {.albedo = path.extension() != ".npy", .loss = path.extension() == ".h5"};
}

}  // namespace ltc
