// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/table_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "export/consistency.h"

namespace ltc {
namespace {

const Format& format_of(const std::filesystem::path& path) {
  if (const Format* const format = find_format(path))
    return *format;
  std::vector<std::string> endings;
  for (const Format& format : formats())
    endings.insert(endings.end(), format.endings.begin(), format.endings.end());
  throw InputError(fmt::format("{}: no suffix of a table; allowed: {}", path.string(),
                               fmt::join(endings, ", ")));
}

// "out/ltc" of "out/ltc.1.exr".
std::filesystem::path prefix_of(const Format& format, const std::filesystem::path& path) {
  std::string name = path.string();
  for (const std::string& ending : format.endings)
    if (name.ends_with(ending))
      return name.substr(0, name.size() - ending.size());
  return name;
}

}  // namespace

Table read_table(const std::filesystem::path& path, std::optional<Layout> layout) {
  const Format& format = format_of(path);
  return format.read(format.files(prefix_of(format, path)), layout);
}

void write_table(const Table& table, const std::filesystem::path& path,
                 const WriteOptions& options) {
  const Format& format = format_of(path);
  platform::FileSet set;
  add_table(set, table, format, prefix_of(format, path), options);
  set.commit();
}

void add_table(platform::FileSet& set, const Table& table, const Format& format,
               const std::filesystem::path& prefix, const WriteOptions& options) {
  const TableFiles files = format.files(prefix);
  require_consistent(table, files.front());
  if (const std::string why = format.why_not(table.grid, table.storage); !why.empty())
    throw InputError(fmt::format("{}: {} cannot hold this table: it {}", files.front().string(),
                                 format.name, why));
  format.add(set, table, files, options);
}

TableFiles files_of_table(const std::filesystem::path& path) {
  const Format* const format = find_format(path);
  return format ? format->files(prefix_of(*format, path)) : TableFiles{path};
}

TableContents contents_of(const std::filesystem::path& path) {
  return format_of(path).contents;
}

bool is_whole_table(const std::filesystem::path& path) {
  const Format* const format = find_format(path);
  return format && keeps_fits(*format);
}

std::string config_text(const std::filesystem::path& file) {
  return is_whole_table(file) ? read_table(file).config : read_config(file);
}

}  // namespace ltc
