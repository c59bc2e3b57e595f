// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "core/error.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_unreadable(const fs::path& path, std::string_view reason) {
  throw IoError(fmt::format("cannot read {}: {}", path.string(), reason));
}

}  // namespace

std::uintmax_t require_readable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error)
    throw_unreadable(path, error.message());
  if (!fs::is_regular_file(status))
    throw_unreadable(path, "it is no regular file");
  errno = 0;
  if (!std::ifstream(path, std::ios::binary))
    throw_unreadable(path, errno ? std::strerror(errno) : "it cannot be opened");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error)
    throw_unreadable(path, error.message());
  return size;
}

void refuse_file(const fs::path& file, const std::string& what) {
  throw InputError(fmt::format("{}: {}", file.string(), what));
}

std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

}  // namespace ltc
