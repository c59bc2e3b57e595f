// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The files of a run: no output takes the place of an input or of another output.
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/output.h"

namespace ltc::cli {

// What a run reads and writes, told before its work begins. Those that options name are told by the
// options' declarations (cli/options.h); a command tells of the others, such as the files in a
// folder. `name` is what the user knows a file by: "--json", "TABLE".
class Files {
 public:
  // A file that is read, with those that belong to it: the textures of a table.
  // Throws InputError if it is told as an output.
  void read(const std::string& name, const std::filesystem::path& file);

  // The same of a file that stands for itself, whatever it is called: an image.
  void read_alone(const std::string& name, const std::filesystem::path& file);

  // A file that is written. Throws InputError if it is an input or another output by any name or
  // link; IoError if it cannot be written: it is a folder or a device, or its own folder is missing
  // or refuses it.
  void write(const std::string& name, const std::filesystem::path& file);

  // A folder that is created if need be, and removed again if nothing comes to lie in it.
  // Throws IoError if it cannot be created or written to.
  const std::filesystem::path& make_folder(const std::filesystem::path& folder);

 private:
  struct File {
    std::string name;
    std::filesystem::path path;
  };
  static void require_apart(const File& file, const std::vector<File>& others);

  std::vector<File> inputs_, outputs_;
  std::deque<OutputFolder> folders_;  // which cannot move
};

}  // namespace ltc::cli
