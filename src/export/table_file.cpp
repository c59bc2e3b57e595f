// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/table_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "export/consistency.h"

namespace ltc {
namespace {

NamedSet require_set(const std::filesystem::path& path) {
  const NamedSet set = set_of(path);
  if (set.format)
    return set;
  std::vector<std::string> endings;
  for (const Format& format : formats())
    for (const std::vector<std::string>& set_endings : format.sets)
      if (is_read(format))
        endings.insert(endings.end(), set_endings.begin(), set_endings.end());
  throw InputError(fmt::format("{}: no suffix of a table; allowed: {}", path.string(),
                               fmt::join(endings, ", ")));
}

}  // namespace

Table read_table(const std::filesystem::path& path, const ReadAs& as) {
  const NamedSet set = require_set(path);
  if (!is_read(*set.format))
    throw InputError(fmt::format("{}: files of {} are only written; allowed: {}", path.string(),
                                 set.format->name, endings_text(is_read)));
  Table table = set.format->read(set.files, as);
  // HDF5 and fields name theirs, OpenEXR any but GGX.
  if (as.model && table.grid.model == &ggx() && !keeps_fits(*set.format) && !set.format->of_fields)
    table.grid.model = as.model;
  return table;
}

void write_table(const Table& table, const std::filesystem::path& path,
                 const WriteOptions& options) {
  const NamedSet named = require_set(path);
  platform::FileSet set;
  add_table(set, table, *named.format, named.prefix, options);
  set.commit();
}

void add_table(platform::FileSet& set, const Table& table, const Format& format,
               const std::filesystem::path& prefix, const WriteOptions& options) {
  const TextureLayout layout = resolved(options.layout, table.grid, table.storage);
  const TableFiles files = format.files(prefix, table.grid, table.storage, layout);
  require_consistent(table, files.front());
  if (const std::string why = format.why_not(table.grid, table.storage, layout); !why.empty())
    throw InputError(fmt::format("{}: {} cannot hold this table: it {}", files.front().string(),
                                 format.name, why));
  if (is_folded(table) && !format.of_folded)
    throw InputError(
        fmt::format("{}: {} cannot hold folded lobes", files.front().string(), format.name));
  if (is_folded(table) && format.of_one_pair && table.creases.size() > 1)
    throw InputError(fmt::format(
        "{}: {} holds folded lobes with one pair of creases, and these have pairs at {}",
        files.front().string(), format.name, fmt::join(table.creases, ", ")));
  if (format.of_fields && !table.field)
    throw InputError(fmt::format("{}: {} holds fields, and this is a table of nodes",
                                 files.front().string(), format.name));
  WriteOptions of_table = options;
  of_table.layout = layout;
  format.add(set, table, files, of_table);
}

TableFiles files_of_table(const std::filesystem::path& path) {
  return set_of(path).files;
}

TableContents contents_of(const std::filesystem::path& path, const Table& table) {
  TableContents contents = require_set(path).format->contents;
  contents.albedo = contents.albedo && !table.without_albedo;
  // Of a table that was baked from a field nobody measured any.
  contents.loss = contents.loss &&
                  std::ranges::any_of(table.sw_loss, [](float loss) { return !std::isnan(loss); });
  return contents;
}

bool is_whole_table(const std::filesystem::path& path) {
  const Format* const format = find_format(path);
  return format && keeps_fits(*format);
}

std::string config_text(const std::filesystem::path& file) {
  const Format* const format = find_format(file);
  const bool has_config =
      format && (keeps_fits(*format) || (format->of_fields && is_read(*format)));
  return has_config ? read_table(file).config : read_config(file);
}

}  // namespace ltc
