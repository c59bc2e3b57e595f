// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A folder of a test's own, removed with all that it holds when the test ends.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ltc::test {

class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

  // Writes a file into the folder and returns its path.
  std::filesystem::path write(std::string_view name, std::string_view content) const;

 private:
  std::filesystem::path path_;
};

// The whole content of a file; throws std::runtime_error if there is none.
std::string read_file(const std::filesystem::path& path);

// The names of all that lies in a folder, hidden files included, sorted.
std::vector<std::string> names_in(const std::filesystem::path& folder);

}  // namespace ltc::test
