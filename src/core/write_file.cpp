// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/write_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/error.h"

namespace ltc {

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  platform::FileSet files;
  add_file(files, path, bytes);
  files.commit();
}

void add_file(platform::FileSet& files, const std::filesystem::path& path, std::string_view bytes) {
  add_file(files, path, std::span(&bytes, 1));
}

void add_file(platform::FileSet& files, const std::filesystem::path& path,
              std::span<const std::string_view> parts) {
  files.add(path, [&](const std::filesystem::path& temporary) {
    errno = 0;
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    for (const std::string_view bytes : parts)
      file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file)
      throw IoError(fmt::format("cannot write {}: {}", path.string(),
                                errno ? std::strerror(errno) : "the system refused"));
  });
}

}  // namespace ltc
