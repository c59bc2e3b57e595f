// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/read_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/error.h"

namespace ltc {

std::string read_first_bytes(const std::filesystem::path& file, std::string_view kind,
                             std::size_t most_bytes) {
  const auto refuse = [&](std::string_view reason) {
    throw IoError(fmt::format("cannot read {} {}: {}", kind, file.string(), reason));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    refuse("it is a folder; expected a file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(
      std::fopen(file.string().c_str(), "rb"), &std::fclose);
  if (!stream)
    refuse(std::strerror(errno));
  // In pieces: most files are far smaller than the most that is allowed.
  constexpr std::size_t piece_bytes = 1 << 20;
  std::string content;
  while (content.size() < most_bytes) {
    const std::size_t begin = content.size();
    const std::size_t wanted = std::min(piece_bytes, most_bytes - begin);
    content.resize(begin + wanted);
    const std::size_t got = std::fread(content.data() + begin, 1, wanted, stream.get());
    content.resize(begin + got);
    if (std::ferror(stream.get()))
      refuse(std::strerror(errno));
    if (got < wanted)
      break;
  }
  return content;
}

std::string read_whole_file(const std::filesystem::path& file, std::string_view kind,
                            std::size_t most_bytes) {
  std::string content = read_first_bytes(file, kind, most_bytes + 1);
  if (content.size() > most_bytes)
    throw InputError(
        fmt::format("{}: larger than {} bytes, which no {} is", file.string(), most_bytes, kind));
  return content;
}

}  // namespace ltc
