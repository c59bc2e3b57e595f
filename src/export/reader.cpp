// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/reader.h"

#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "export/exr.h"
#include "export/hdf5.h"
#include "export/npy.h"

namespace ltc {
namespace {

constexpr int textures = 3;

std::string texture_ending(int index) {
  return fmt::format(".{}.exr", index);
}

// "out/ltc" of "out/ltc.1.exr".
std::optional<std::string> texture_prefix(const std::filesystem::path& path) {
  const std::string name = path.string();
  for (int index = 0; index < textures; ++index)
    if (const std::string ending = texture_ending(index); name.ends_with(ending))
      return name.substr(0, name.size() - ending.size());
  return std::nullopt;
}

}  // namespace

Table read_table(const std::filesystem::path& path, std::optional<Layout> layout) {
  if (path.extension() == ".h5")
    return read_hdf5(path);
  if (path.extension() == ".npy")
    return read_npy(path, layout);
  if (const auto prefix = texture_prefix(path))
    return read_exr(*prefix);
  throw InputError(fmt::format(
      "{}: no suffix of a table; allowed: .h5, .npy, .0.exr, .1.exr, .2.exr", path.string()));
}

std::vector<std::filesystem::path> files_of_table(const std::filesystem::path& path) {
  const auto prefix = texture_prefix(path);
  std::vector<std::filesystem::path> files;
  for (int index = 0; prefix && index < textures; ++index)
    files.emplace_back(*prefix + texture_ending(index));
  if (!prefix)
    files.push_back(path);
  return files;
}

TableContents contents_of(const std::filesystem::path& path) {
  return {.albedo = path.extension() != ".npy", .loss = path.extension() == ".h5"};
}

}  // namespace ltc
