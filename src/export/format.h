// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The formats of table files, each in a file of its own, and the list of them. All that reads,
// writes or names tables' files asks the list.
#pragma once

#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "core/platform.h"
#include "table/table.h"

namespace ltc {

// What a format holds beside axes and matrices.
struct TableContents {
  bool albedo = true;  // amplitude and Fresnel
  bool loss = true;    // and what else is known of the fits, with the config that made them
};

struct WriteOptions {
  bool half = false;  // 16-bit values, where the format has them
};

// The files of one table, in the order of the format's endings.
using TableFiles = std::vector<std::filesystem::path>;

struct Format {
  std::string name;  // as users know it: "NPY"
  // What the names of the files end in, one a file of the set: ".0.exr", ".1.exr", ".2.exr".
  std::vector<std::string> endings;
  bool OutputSettings::*asked = nullptr;  // the key of [output] that asks for it; null: none does
  TableContents contents = {};
  std::size_t entry_bytes = 0;  // of an entry, uncompressed, in values of 32 bits
  bool half = false;            // whether it has 16-bit values
  bool without_axes = false;    // whether a reader is to be told the layout of the grid
  // Why it cannot hold tables of this grid and storage, after "it"; empty where it can. Null: it
  // holds all.
  std::string (*limits)(const Grid& grid, Storage storage) = nullptr;
  // Throws IoError for a file that cannot be opened; InputError, naming file and fault, for one
  // that is none of the format or damaged, or disagrees with the others of the set.
  Table (*read)(const TableFiles& files, std::optional<Layout> layout) = nullptr;
  // Adds the files to those that take their places with set.commit(); the same table gives the same
  // bytes. The table is consistent (export/consistency.h) and one that the format can hold.
  void (*add)(platform::FileSet& set, const Table& table, const TableFiles& files,
              const WriteOptions& options) = nullptr;

  TableFiles files(const std::filesystem::path& prefix) const;
  // The same for any format: one that names its axes calls them alpha and lambda.
  std::string why_not(const Grid& grid, Storage storage) const;
  // Whether [output] asks for it, and whether it can hold the config's table too.
  bool is_asked(const OutputSettings& output) const { return asked && output.*asked; }
  bool is_written(const Config& config) const {
    return is_asked(config.output) && why_not(config.grid, config.storage).empty();
  }
};

// In the order in which files are written and named.
const std::list<Format>& formats();

// One more format for as long as this lives. Not while tables are read or written.
class AddedFormat {
 public:
  explicit AddedFormat(Format format);
  ~AddedFormat();
  AddedFormat(const AddedFormat&) = delete;
  AddedFormat& operator=(const AddedFormat&) = delete;

 private:
  std::list<Format>::iterator place_;
};

// Whether a format keeps all that is known of the fits, with the config that made them.
inline bool keeps_fits(const Format& format) {
  return format.contents.loss;
}

// The format of a file of such a name; null where none has its ending.
const Format* find_format(const std::filesystem::path& file);

// ".h5, .0.exr or .npy": what the first file's name ends in, of all formats that `which` takes.
std::string endings_text(const std::function<bool(const Format&)>& which = [](const Format&) {
  return true;
});

}  // namespace ltc
