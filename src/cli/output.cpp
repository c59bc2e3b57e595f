// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "core/error.h"
#include "core/platform.h"

namespace ltc::cli {

namespace fs = std::filesystem;

void print(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0)
    throw IoError(fmt::format("cannot write to standard output: {}", std::strerror(errno)));
}

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text)
    if (c == '\n')
      line += "\\n";
    else if (const auto code = static_cast<unsigned char>(c); code < 0x20 || code == 0x7f)
      line += fmt::format("\\x{:02x}", code);
    else
      line += c;
  return line;
}

OutputFolder::OutputFolder(fs::path path) : path_(std::move(path)) {
  std::error_code ignored;
  fs::path missing = fs::absolute(path_);  // as written: "a/../b" creates a too
  for (; missing.has_relative_path() && !fs::exists(missing, ignored);
       missing = missing.parent_path())
    created_.insert(created_.begin(), missing);
  try {
    platform::require_writable_folder(path_);
  } catch (...) {
    remove_created();
    throw;
  }
}

OutputFolder::~OutputFolder() {
  remove_created();
}

void OutputFolder::remove_created() {
  std::error_code ignored;
  for (auto folder = created_.rbegin(); folder != created_.rend(); ++folder)
    fs::remove(*folder, ignored);  // refuses a folder that holds anything
}

std::optional<OutputFolder> folder_of_file(const std::filesystem::path& file) {
  if (file.empty())
    return std::nullopt;
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw IoError(fmt::format("cannot write {}: it is a folder", file.string()));
  return std::optional<OutputFolder>(std::in_place,
                                     file.has_parent_path() ? file.parent_path() : ".");
}

}  // namespace ltc::cli
