// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/read_file.h"

#include <fmt/format.h>

#include <cstring>
#include <system_error>

#include "core/error.h"
#include "core/platform.h"

namespace ltc {

namespace {

std::string read_pieces(const std::filesystem::path& file, std::string_view kind,
                        std::size_t most_bytes, bool again) {
  const auto refuse = [&](std::string_view reason) {
    throw IoError(fmt::format("cannot read {} {}: {}", kind, file.string(), reason));
  };
  std::error_code ignored;
  const std::filesystem::file_type type = std::filesystem::status(file, ignored).type();
  if (type == std::filesystem::file_type::directory)
    refuse("it is a folder; expected a file");
  if (again && type == std::filesystem::file_type::fifo)
    refuse("it is a pipe, which can be read only once; expected a file");
  std::string content;
  try {
    content = platform::read_up_to(file, most_bytes);
  } catch (const std::system_error& error) {
    refuse(std::strerror(error.code().value()));
  }
  return content;
}

}  // namespace

std::string read_first_bytes(const std::filesystem::path& file, std::string_view kind,
                             std::size_t most_bytes) {
  return read_pieces(file, kind, most_bytes, true);
}

std::string read_whole_file(const std::filesystem::path& file, std::string_view kind,
                            std::size_t most_bytes) {
  std::string content = read_pieces(file, kind, most_bytes + 1, false);
  if (content.size() > most_bytes)
    throw InputError(
        fmt::format("{}: larger than {} bytes, which no {} is", file.string(), most_bytes, kind));
  return content;
}

}  // namespace ltc
