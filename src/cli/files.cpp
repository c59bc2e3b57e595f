// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/files.h"

#include <fmt/format.h>

#include <system_error>

#include "core/error.h"
#include "core/platform.h"
#include "export/table_file.h"

namespace ltc::cli {
namespace {

namespace fs = std::filesystem;

// Of two files that need not be there: by links of every kind, or by their names.
bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error)
    return true;
  const auto full_name = [&](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path, error), error);
  };
  return full_name(a) == full_name(b);
}

}  // namespace

void Files::read(const std::string& name, const fs::path& file) {
  for (const fs::path& part : files_of_table(file))
    read_alone(name, part);
}

void Files::read_alone(const std::string& name, const fs::path& file) {
  inputs_.push_back({name, file});
  require_apart(inputs_.back(), outputs_);
}

void Files::write(const std::string& name, const fs::path& file) {
  const File output{name, file};
  require_apart(output, inputs_);
  require_apart(output, outputs_);
  platform::require_writable_file(file);
  outputs_.push_back(output);
}

const fs::path& Files::make_folder(const fs::path& folder) {
  return folders_.emplace_back(folder).path();
}

void Files::require_apart(const File& file, const std::vector<File>& others) {
  for (const File& other : others)
    if (same_file(file.path, other.path))
      throw InputError(fmt::format("{} {} is the same file as {} {}; expected different files",
                                   file.name, file.path.string(), other.name, other.path.string()));
}

}  // namespace ltc::cli
