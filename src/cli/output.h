// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How the program writes to the terminal and prepares the folder that it writes to.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/shell_quoted.h"

namespace ltc::cli {

// Writes to standard output and makes sure that it arrived: throws IoError if not (a full disk).
void print(std::string_view text);

// The text on one line: control characters escaped.
std::string one_line(std::string_view text);

// The folder that a run writes into. What had to be created for it is removed again if the run ends
// before anything was written.
class OutputFolder {
 public:
  // Throws IoError if the folder cannot be created or written to.
  explicit OutputFolder(std::filesystem::path path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  void remove_created();  // those that are empty

  std::filesystem::path path_;
  std::vector<std::filesystem::path> created_;  // outermost first
};

// The folder of a file that is to be written, created if need be: better now than after the work.
// None where the name is empty. Throws IoError as OutputFolder, and where the name is a folder's.
std::optional<OutputFolder> folder_of_file(const std::filesystem::path& file);

}  // namespace ltc::cli
