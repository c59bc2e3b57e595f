// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How the program writes to the terminal and prepares the folder that it writes to.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/shell_quoted.h"

namespace ltc::cli {

// Writes to standard output and makes sure that it arrived: throws IoError if not (a full disk).
void print(std::string_view text);

// The results of a command: as JSON where --json asks for it, and as text on standard output,
// except where that is where the JSON goes ("-"). Throws IoError as print and write_file.
void print_results(const std::string& json_file, const std::function<std::string()>& text,
                   const std::function<std::string()>& json);

// The line as a warning on standard error.
void warn(const std::string& line);

// Writes to standard error, if that takes it: what is told there is worth no failure.
void tell(std::string_view text);

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

}  // namespace ltc::cli
