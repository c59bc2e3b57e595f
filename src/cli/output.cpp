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
#include "core/write_file.h"

namespace ltc::cli {

namespace fs = std::filesystem;

void print(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0)
    throw IoError(fmt::format("cannot write to standard output: {}", std::strerror(errno)));
}

void print_results(const std::string& json_file, const std::function<std::string()>& text,
                   const std::function<std::string()>& json) {
  if (json_file == "-") {
    print(json());
    return;
  }
  if (!json_file.empty())
    write_file(json_file, json());
  print(text());
}

void tell(std::string_view text) {
  // Not fmt::print, which throws, and as one write: lines of several threads stay apart.
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void warn(const std::string& line) {
  tell(fmt::format("ltcfit: warning: {}\n", one_line(line)));
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
  // A link that leads nowhere is there too, and not ours to remove.
  for (; missing.has_relative_path() && !fs::exists(fs::symlink_status(missing, ignored));
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

}  // namespace ltc::cli
